"use strict";

/** The changes of a picture's pixels, by time. */
class Film {
    constructor(picture, columns) {
        Object.assign(this, { picture, end: picture.end, period: picture.clock.picoseconds });
        [this.clock, this.pixel, this.unit, this.depth, this.colour] = columns;
        for (const column of [this.clock, this.pixel]) {
            for (let i = 1; i < column.length; i++) column[i] += column[i - 1];
        }
        this.count = this.clock.length;
        this.link();
    }

    static async of(picture) {
        return new Film(picture, await unpack(picture.writes, 5));
    }

    /** For each change, the one before of the same pixel, or -1, and how many there were of it. */
    link() {
        const [width, height] = this.picture.size;
        const last = new Int32Array(width * height).fill(-1);
        this.before = new Int32Array(this.count);
        this.layer = new Uint16Array(this.count);
        this.deepest = 1;
        this.depths = [0xffffffff, 0];
        for (let i = 0; i < this.count; i++) {
            const before = this.before[i] = last[this.pixel[i]];
            last[this.pixel[i]] = i;
            this.layer[i] = before < 0 ? 1 : this.layer[before] + 1;
            this.deepest = Math.max(this.deepest, this.layer[i]);
            this.depths = [Math.min(this.depths[0], this.depth[i]), Math.max(this.depths[1], this.depth[i])];
        }
        this.last = last;
    }

    /** How many changes there are until a clock, that clock included. */
    until(clock) {
        let [low, high] = [0, this.count];
        while (low < high) {
            const middle = low + high >> 1;
            if (this.clock[middle] <= clock) low = middle + 1; else high = middle;
        }
        return low;
    }

    /** The clock of the first change after a clock, or the end. */
    after(clock) {
        const next = this.until(clock);
        return next < this.count ? this.clock[next] : this.end;
    }

    /** The clock of the last change before a clock, or the beginning. */
    ahead(clock) {
        const next = this.until(clock - 1);
        return next > 0 ? this.clock[next - 1] : 0;
    }

    /** All changes of a pixel, by time. */
    changes(pixel) {
        const found = [];
        for (let i = this.last[pixel]; i >= 0; i = this.before[i]) found.unshift(i);
        return found;
    }
}
