"use strict";

/** A colour as a canvas on a processor with the low byte first has it. */
const packed = (red, green, blue) => (255 << 24 | blue << 16 | green << 8 | red) >>> 0;
const NOBODY = packed(38, 40, 44);

/** From dark to light, for depths, layers and times. */
const ramp = share => {
    const stops = [[24, 30, 78], [40, 104, 140], [90, 168, 120], [214, 200, 96], [252, 244, 206]];
    const place = Math.min(Math.max(share, 0), 1) * (stops.length - 1);
    const low = Math.min(Math.floor(place), stops.length - 2);
    return packed(...stops[low].map((part, i) => Math.round(part + (stops[low + 1][i] - part) * (place - low))));
};

/** The ways to colour a pixel: each has a name, the colour of a change, and that of a pixel without one. */
const PAINTS = {
    frame: {
        name: "of the frame",
        of: (film, i) => packed(film.colour[i] >> 16, film.colour[i] >> 8 & 255, film.colour[i] & 255),
        empty: film => packed(...film.picture.background),
    },
    units: {
        name: "of the unit that drew it",
        of: (film, i) => {
            const shown = film.colour[i];
            // As light as the frame.
            const share = 0.45 + 0.75 * Math.max(shown >> 16, shown >> 8 & 255, shown & 255) / 255;
            return packed(...film.picture.units[film.unit[i]].colour.map(it => Math.min(255, Math.round(it * share))));
        },
        empty: () => NOBODY,
    },
    depth: {
        name: "depth: near is light",
        of: (film, i) => ramp(1 - (film.depth[i] - film.depths[0]) / Math.max(1, film.depths[1] - film.depths[0])),
        empty: () => NOBODY,
    },
    time: {
        name: "time: late is light",
        of: (film, i) => ramp((film.clock[i] - film.clock[0]) / Math.max(1, film.clock[film.count - 1] - film.clock[0])),
        empty: () => NOBODY,
    },
    layers: {
        name: "how often it changed",
        of: (film, i) => ramp(film.layer[i] / film.deepest),
        empty: () => NOBODY,
    },
};

/** A picture on a canvas, at some change. */
class Painter {
    constructor(film, canvas, over) {
        const [width, height] = film.picture.size;
        Object.assign(this, { film, at: 0, fresh: [] });
        [this.canvas, this.over] = [canvas, over].map(it => {
            Object.assign(it, { width, height });
            // Pixels come from memory at each drawing.
            const context = it.getContext("2d", { willReadFrequently: true });
            const image = context.createImageData(width, height);
            return { context, image, pixels: new Uint32Array(image.data.buffer) };
        });
        this.top = new Int32Array(width * height).fill(-1);
        this.paintAs("frame");
    }

    paintAs(name) {
        this.paint = PAINTS[name];
        this.top.forEach((change, pixel) => this.put(pixel, change));
    }

    put(pixel, change) {
        this.top[pixel] = change;
        this.canvas.pixels[pixel] = change < 0 ? this.paint.empty(this.film) : this.paint.of(this.film, change);
    }

    /** Shows the picture after so many changes. */
    seek(to) {
        const { pixel, before } = this.film;
        for (; this.at < to; this.at++) this.put(pixel[this.at], this.at);
        while (this.at > to) {
            this.at--;
            this.put(pixel[this.at], before[this.at]);
        }
    }

    /** Highlights what changed from one change to the present one, or nothing. */
    highlight(from) {
        const pixels = this.over.pixels;
        this.fresh.forEach(pixel => pixels[pixel] = 0);
        this.fresh = Array.from(this.film.pixel.subarray(from, this.at));
        this.fresh.forEach(pixel => pixels[pixel] = packed(255, 60, 200));
    }

    draw() {
        for (const { context, image } of [this.canvas, this.over]) context.putImageData(image, 0, 0);
    }
}
