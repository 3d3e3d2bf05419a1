"use strict";

/** The pixels that have been asked about, by machine, camera and place. */
const whys = new Map();

/** Why a pixel has its colour on a machine: the server draws again and follows it. */
class Why {
    constructor(panel, { x, y }, go) {
        Object.assign(this, { panel, go, name: `way/${panel.machine.name}`, query: `${panel.query}&x=${x}&y=${y}`, ticket: null });
        this.element = make("div", { className: "why" });
        this.offer();
    }

    /** Offers to ask. */
    offer(sentence = "") {
        this.ticket = null;
        const ask = make("button", { className: "ask" }, `Why has it this colour on ${this.panel.machine.name}?`);
        ask.addEventListener("click", () => this.ask());
        this.element.replaceChildren(...(sentence ? [make("p", { className: "bad", role: "alert" }, sentence)] : []), ask);
        this.state = "offered";
    }

    /** Asks, and says what the server does meanwhile. */
    async ask() {
        if (this.state !== "offered") return;
        const ticket = this.ticket = Symbol(this.query);
        this.state = "asking";
        const bar = make("progress", { max: 1, "aria-label": "Progress of following the pixel" }), said = make("span");
        const stop = make("button", { className: "stop" }, "Stop");
        stop.addEventListener("click", () => this.stop());
        this.element.replaceChildren(make("div", { className: "bar", role: "status" }, said, bar, stop));
        const tell = ({ what, done }) => {
            if (ticket !== this.ticket) throw new Stopped();
            said.textContent = `Following the pixel: ${what} …`;
            if (typeof done === "number") bar.value = done; else bar.removeAttribute("value");
        };
        tell({ what: "asking" });
        try {
            const way = await load(this.name, this.query, tell);
            if (ticket === this.ticket) this.show(way);
        } catch (error) {
            if (ticket === this.ticket) this.offer(error.message);
        }
    }

    /** Asks no more. The server stops its work, too. */
    stop() {
        if (this.state !== "asking") return;
        this.offer();
        fetch(`data/${this.name}?${this.query}&stop`).catch(() => {});
    }

    /** Shows the way. */
    show(way) {
        this.state = "told";
        this.element.replaceChildren(...wayParts(way, {
            go: picoseconds => this.go(this.panel, Math.floor(picoseconds / this.panel.film.period)),
            look: number => moment.look(this, way.steps[number], number),
        }));
    }
}

/** The part of a pixel that tells why. */
const why = (panel, pixel, go) => {
    if (IS_EXPORTED) return panel.silent ??= make("p", { className: "hint" }, "Why it has this colour is told by a machine that draws again: tilewright view serves a page with it.");
    const key = `${panel.machine.name} ${panel.query} ${pixel.x} ${pixel.y}`;
    if (!whys.has(key)) whys.set(key, new Why(panel, pixel, go));
    const known = whys.get(key);
    known.panel = panel;
    return known.element;
};

/** Asks why a pixel has its colour on a machine. Whatever else is asked is stopped; a second time stops this, too. */
const askWhy = (panel, pixel) => {
    if (IS_EXPORTED || !panel.film) return;
    const key = `${panel.machine.name} ${panel.query} ${pixel.x} ${pixel.y}`, asked = whys.get(key);
    const wasAsking = asked?.state === "asking";
    for (const it of whys.values()) it.stop();
    if (asked && !wasAsking) asked.ask();
};
