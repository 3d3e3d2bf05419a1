"use strict";

/** Pixels of a clock, of a line, and of the slope of a change. */
const CELL = 46, LINE = 26, SLOPE = 4;
/** Pixels of a character of a name, and of a value. */
const LETTER = 7.3;

const SVG = "http://www.w3.org/2000/svg";
const shape = (tag, attributes = {}, text = "") => {
    const element = document.createElementNS(SVG, tag);
    for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
    element.textContent = text;
    return element;
};

/** The wave of some nets, as many clocks as there is room for, with a cursor at the present one. */
class Wave {
    constructor(moved) {
        this.begin = 0;
        this.moved = moved;
        this.element = make("div", { className: "wave", tabIndex: 0, role: "slider", "aria-label": "Cursor in the wave: arrow keys move it by a clock", "aria-valuemin": 0 });
        this.element.addEventListener("click", event => {
            const at = Math.floor((event.clientX - this.element.getBoundingClientRect().left - this.left) / CELL);
            if (at >= 0 && at < this.count) moved(this.begin + at);
        });
    }

    /** Shows the nets with the cursor at that step. */
    draw({ times, first = 0 }, nets, step) {
        const width = Math.max(200, this.element.clientWidth), last = times.length - 1;
        const longest = Math.max(4, ...nets.map(({ name }) => name.length));
        this.left = Math.round(Math.min(longest * LETTER + 12, Math.max(90, width * 0.36)));
        const room = Math.max(1, Math.floor((width - this.left) / CELL));
        this.count = Math.min(times.length, room);
        this.scroll(step, last);
        const height = LINE * (nets.length + 1), right = this.left + CELL * this.count;
        const svg = shape("svg", { width, height, "aria-hidden": "true" });
        svg.append(shape("rect", { class: "cursor", x: this.left + CELL * (step - this.begin), y: 0, width: CELL, height }));
        for (let at = 0; at < this.count; at++) {
            const number = first + this.begin + at, x = this.left + CELL * at;
            if (number % (first + last > 9999 ? 2 : 1) === 0) svg.append(shape("text", { class: "clock", x: x + 4, y: LINE - 9 }, String(number)));
            svg.append(shape("path", { class: "edge", d: `M${x} ${LINE - 4}V${height}` }));
        }
        nets.forEach((net, number) => this.line(svg, net, LINE * (number + 1), right));
        this.element.replaceChildren(svg);
        this.element.setAttribute("aria-valuemax", first + last);
        this.element.setAttribute("aria-valuenow", first + step);
        this.element.setAttribute("aria-valuetext", `clock ${first + step}; ${nets.slice(0, 8).map(net => `${net.name} ${valueAt(net, step)}`).join(", ")}`);
    }

    /** Keeps the cursor in sight, with a clock on each side where there is one. */
    scroll(step, last) {
        const margin = this.count > 4 ? 1 : 0;
        this.begin = Math.min(this.begin, Math.max(0, step - margin));
        this.begin = Math.max(this.begin, step + margin - this.count + 1);
        this.begin = Math.max(0, Math.min(this.begin, last - this.count + 1));
    }

    line(svg, net, top, right) {
        const [high, low] = [top + 5, top + LINE - 6], middle = (high + low) / 2;
        const name = shape("text", { class: `name${net.asked ? " asked" : ""}`, x: 2, y: top + LINE - 9 }, shortenedName(net.name, Math.floor((this.left - 8) / LETTER)));
        name.append(shape("title", {}, net.name));
        svg.append(name);
        const isBit = net.width === 1 && net.changes.every(([, value]) => value === "0" || value === "1");
        for (let at = 0; at < this.count;) {
            const value = valueAt(net, this.begin + at), from = at;
            while (at < this.count && valueAt(net, this.begin + at) === value) at++;
            const [x, end] = [this.left + CELL * from, this.left + CELL * at];
            const [begins, goesOn] = [from > 0, at < this.count];
            if (isBit) {
                const y = value === "1" ? high : low, other = high + low - y;
                svg.append(shape("path", { class: "level", d: `${begins ? `M${x} ${other}V${y}` : `M${x} ${y}`}H${end}` }));
                continue;
            }
            const begin = begins ? `M${x} ${middle}L${x + SLOPE} ${high}` : `M${x} ${high}`;
            const close = goesOn ? `L${end} ${middle}L${end - SLOPE} ${low}` : `M${end} ${low}`;
            svg.append(shape("path", { class: "bus", d: `${begin}H${goesOn ? end - SLOPE : Math.min(end, right)}${close}H${begins ? x + SLOPE : x}${begins ? `L${x} ${middle}` : ""}` }));
            const most = Math.floor((end - x - 2 * SLOPE) / LETTER);
            svg.append(shape("text", { class: "value", x: x + SLOPE + 3, y: top + LINE - 9 }, shortened(value, most)));
        }
    }
}
