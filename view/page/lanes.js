"use strict";

/** Colours of activities: of work, and of waiting. */
const WORK = ["#2f7fc1", "#c8641f", "#2a9273", "#9a5cb8", "#a58a1c", "#6a7683", "#b8466a", "#5d8a2f"];
const WAITS = ["#b9b2a4", "#8d8778", "#d0c5ae", "#776f60"];

/** What the units of a machine do over time. */
class Lanes {
    constructor(film) {
        this.film = film;
        const { kinds, lanes, machine } = film.picture;
        const counts = { true: 0, false: 0 };
        this.colours = kinds.map(({ waits }) => (waits ? WAITS : WORK)[counts[waits]++ % (waits ? WAITS : WORK).length]);
        const legend = make("div", { className: "legend" }, ...kinds.map(({ name }, i) => make("span", {}, swatch(this.colours[i]), name)));
        this.rows = lanes.map(lane => this.row(lane));
        this.element = make("div", {}, make("h3", {}, machine), legend, ...this.rows.map(row => row.element));
    }

    row(lane) {
        const unit = this.film.picture.units.find(({ name }) => name === lane.name);
        const canvas = make("canvas", { width: 900, height: 12, role: "img", "aria-label": `What ${lane.name} does over time` });
        const context = canvas.getContext("2d"), scale = canvas.width / Math.max(1, this.film.end);
        for (const [from, to, shares] of lane.parts) {
            let top = canvas.height;
            for (const [kind, share] of shares) {
                context.fillStyle = this.colours[kind];
                context.fillRect(from * scale, top, Math.max((to - from) * scale, 0.5), -share * canvas.height);
                top -= share * canvas.height;
            }
        }
        const now = make("i"), does = make("span", { className: "does" });
        const strip = make("div", { className: "strip" }, canvas, now);
        const name = make("span", {}, ...(unit ? [swatch(css(unit.colour))] : []), lane.name);
        return { lane, now, does, element: make("div", { className: "lane" }, name, strip, does) };
    }

    draw(clock) {
        for (const { lane, now, does } of this.rows) {
            now.style.left = `${100 * clock / Math.max(1, this.film.end)}%`;
            const text = this.at(lane, clock);
            if (does.textContent !== text) does.textContent = text;
        }
    }

    /** What a unit does at a clock, in words. */
    at(lane, clock) {
        const part = lane.parts.find(([from, to]) => from <= clock && clock < to);
        if (!part) return "nothing";
        const shares = part[2].map(([kind, share]) =>
            this.film.picture.kinds[kind].name + (share > 0.995 ? "" : ` ${Math.max(1, Math.round(100 * share))} %`));
        return shares.join(", ");
    }
}
