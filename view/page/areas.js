"use strict";

/** Parts of the screen that units work on for some time. */
class Areas {
    constructor({ name, levels }, columns) {
        Object.assign(this, { name, levels });
        [this.from, this.to, this.unit, this.place, this.size] = columns;
        for (let i = 1; i < this.from.length; i++) this.from[i] += this.from[i - 1];
        for (let i = 0; i < this.from.length; i++) this.to[i] += this.from[i];
    }

    static async of(data) {
        return new Areas(data, await unpack(data.list, 5));
    }

    /** The numbers of those that last at a clock. */
    at(clock) {
        const found = [];
        for (let i = 0; i < this.from.length && this.from[i] <= clock; i++) if (this.to[i] > clock) found.push(i);
        return found;
    }

    /** Draws those of a clock on a canvas of the picture's shape. Windows have the colour of their level, pages that of their unit. */
    draw(canvas, film, clock) {
        const [width, height] = film.picture.size, now = this.at(clock), context = canvas.getContext("2d", { willReadFrequently: true });
        [canvas.width, canvas.height] = [canvas.clientWidth * devicePixelRatio, canvas.clientHeight * devicePixelRatio].map(Math.round);
        context.scale(canvas.width / width, canvas.height / height);
        const pixel = width / canvas.width;
        for (const i of now) {
            const [x, y, w, h] = [this.place[i] & 0xffff, this.place[i] >>> 16, this.size[i] & 0xffff, this.size[i] >>> 16];
            if (this.levels > 0) {
                context.strokeStyle = this.colour(this.unit[i] >>> 16);
                context.lineWidth = 1.5 * pixel * devicePixelRatio;
                context.strokeRect(x, y, w, h);
            } else {
                context.fillStyle = css(film.picture.units[this.unit[i] & 0xffff].colour);
                context.globalAlpha = 0.3;
                context.fillRect(x, y, w, h);
                context.globalAlpha = 1;
                context.strokeStyle = "rgb(255 255 255 / .35)";
                context.lineWidth = pixel;
                context.strokeRect(x, y, w, h);
            }
        }
        return now.length;
    }

    colour(level) {
        return `hsl(${Math.round(300 * level / Math.max(1, this.levels))} 90% 62%)`;
    }

    /** Which colour means what. */
    legend() {
        if (this.levels === 0) return [];
        return Array.from({ length: this.levels + 1 }, (_, level) => make("span", {}, swatch(this.colour(level)), String(level)));
    }
}
