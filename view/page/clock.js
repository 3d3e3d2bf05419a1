"use strict";

/** Seconds that the whole frame may take. */
const SPEEDS = [80, 40, 20, 10, 5, 2.5];

/** The time that all pictures share, from 0 to 1 of the longest or of each. */
class Playing {
    constructor(changed) {
        Object.assign(this, { share: 1, seconds: 10, isPlaying: false, changed });
    }

    go(share) {
        this.share = Math.min(Math.max(share, 0), 1);
        this.changed();
    }

    play() {
        if (this.share >= 1) this.share = 0;
        this.isPlaying = true;
        this.changed();
        let last = performance.now();
        const tick = now => {
            if (!this.isPlaying) return;
            this.share = Math.min(1, this.share + Math.max(0, now - last) / (1000 * this.seconds));
            this.isPlaying = this.share < 1;
            last = now;
            this.changed();
            if (this.isPlaying) requestAnimationFrame(tick);
        };
        requestAnimationFrame(tick);
    }

    pause() {
        this.isPlaying = false;
        this.changed();
    }

    toggle() {
        if (this.isPlaying) this.pause(); else this.play();
    }

    /** Another speed: by one faster or slower. */
    change(by) {
        const place = SPEEDS.indexOf(this.seconds) + by;
        this.seconds = SPEEDS[Math.min(Math.max(place, 0), SPEEDS.length - 1)];
        this.changed();
    }
}
