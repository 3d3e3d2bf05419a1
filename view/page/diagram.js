"use strict";

/** The most characters of a value beside a box. */
const MOST_BESIDE = 10;

/** How far a value is moved to where nothing is in its way: one beside the only name of a box, and one of several, which must not get to another name. */
const FARTHEST = { single: 14, several: 5 };
/** Moves up and down, the nearest first. */
const shifts = farthest => Array.from({ length: 4 * farthest + 1 }, (_, place) => (place % 2 ? -0.5 : 0.5) * Math.ceil(place / 2));
/** The room of a text above and below its digits that may meet others: little, or else all of it. */
const GAPS = [1.5, 3];

/** What stands beside a name of a box: the value of its net, or the word of a stream while it is valid. */
const valueBeside = (name, own, step) => {
    const of = name => own.find(it => it.name === name);
    if (of(name)) return valueAt(of(name), step);
    const [valid, ready] = [of(`${name}_valid`), of(`${name}_ready`)];
    if (!valid || valueAt(valid, step) !== "1") return "";
    const words = own.filter(it => it !== valid && it !== ready);
    return words.length === 1 ? valueAt(words[0], step) : "valid";
};

/** A rectangle from the corner of the diagram. */
const within = ({ left, right, top, bottom }, origin) =>
    ({ left: left - origin.left, right: right - origin.left, top: top - origin.top, bottom: bottom - origin.top });

/** A rectangle without so much of it above and below. */
const cut = (place, gap) => ({ ...place, top: place.top + gap, bottom: place.bottom - gap });

const moved = (place, shift) => ({ ...place, top: place.top + shift, bottom: place.bottom + shift });

const meets = (one, other) => one.left < other.right && other.left < one.right && one.top < other.bottom && other.top < one.bottom;

/** What a value should not cover in a diagram: heads and labels of arrows, and their lines. */
const obstacles = (svg, origin) => {
    const marks = [...svg.querySelectorAll(".head, .label")].map(it => within(it.getBoundingClientRect(), origin));
    return { marks, lines: [...svg.querySelectorAll("path.line")].flatMap(line => parts(line, origin)) };
};

/** The straight parts of a line. */
const parts = (line, origin) => {
    const { a, d, e, f } = line.getScreenCTM(), all = [];
    let [x, y] = [0, 0];
    for (const [, command, first, second] of line.getAttribute("d").matchAll(/([MHV])\s*([-\d.]+)(?:[ ,]+([-\d.]+))?/g)) {
        const [toX, toY] = [command === "V" ? x : Number(first), { M: Number(second), H: y, V: Number(first) }[command]];
        const [left, right, top, bottom] = [Math.min(x, toX) - 1, Math.max(x, toX) + 1, Math.min(y, toY) - 1, Math.max(y, toY) + 1];
        if (command !== "M") all.push(within({ left: a * left + e, right: a * right + e, top: d * top + f, bottom: d * bottom + f }, origin));
        [x, y] = [toX, toY];
    }
    return all;
};

/** The block diagram of a unit. Its boxes have the values of their nets, and open the units that they stand for. */
class Diagram {
    constructor({ chosen, opened }) {
        Object.assign(this, { chosen, opened, boxes: [] });
        this.element = make("div", { className: "diagram-of-unit scroll" });
    }

    /** Puts the diagram in the page, and finds its boxes by the names in their titles. */
    place(svg, nets, units) {
        this.element.innerHTML = svg;
        this.obstacles = null;
        const known = new Set(nets.map(({ name }) => name));
        const titles = [...this.element.querySelectorAll("g > title")];
        this.boxes = titles.map(title => this.box(title, known, units)).filter(({ names, units }) => names.length + units.length > 0);
        this.boxes.forEach(box => this.connect(box));
    }

    box(title, known, units) {
        const members = title.textContent.split("\n");
        // An array has a unit for each of its lanes.
        const of = member => units.filter(({ name }) => name === member || name.startsWith(`${member}[`));
        const lanes = name => [...known].filter(it => it.startsWith(`${name}[`));
        const names = members.flatMap(name => known.has(name) ? [name] : lanes(name));
        return { title, group: title.parentElement, members, names, units: members.flatMap(of) };
    }

    connect(box) {
        const { group, units, names } = box;
        const act = () => units.length > 0 ? this.opened(units[0]) : this.chosen(names);
        group.classList.add(units.length > 0 ? "box-of-units" : "box-of-nets");
        group.setAttribute("tabindex", 0);
        group.setAttribute("role", "button");
        group.addEventListener("click", act);
        group.addEventListener("keydown", event => {
            if (event.key !== "Enter" && event.key !== " ") return;
            event.preventDefault();
            event.stopPropagation();
            act();
        });
    }

    /** Frames the boxes whose nets changed, and writes their values beside them. */
    draw(nets, step, chosen) {
        for (const box of this.boxes) {
            const { group, title, names, members, units } = box;
            const own = nets.filter(({ name }) => names.includes(name));
            group.classList.toggle("changed", own.some(net => isChanged(net, step)));
            group.classList.toggle("asked", own.some(net => net.asked));
            group.classList.toggle("chosen", chosen !== null && chosen.join() === names.join());
            const said = members.map(name => {
                const net = own.find(it => it.name === name);
                return net ? `${name} = ${valueAt(net, step)}` : name;
            });
            title.textContent = said.join("\n");
            group.setAttribute("aria-label", units.length > 0 ? `Open ${members.join(", ")}` : `List the nets ${said.join(", ")}`);
            this.write(box, own, step);
        }
        this.settle();
    }

    /** Writes the values of a box beside its names; where these stand for others, too, nothing. */
    write({ group }, own, step) {
        group.querySelectorAll(".of-net").forEach(it => it.remove());
        const lines = [...group.querySelectorAll("text.name")], outline = group.querySelector(".box:not(.behind)");
        if (!outline || own.length === 0) return;
        const { x, width } = outline.getBBox();
        // Ports on the right get their values where the arrows come in.
        const isOutput = outline.classList.contains("port") && group.ownerSVGElement.getBBox().width / 2 < x;
        for (const line of lines) {
            const value = valueBeside(line.textContent, own, step);
            if (value === "") continue;
            group.append(shape("text", {
                class: `of-net${step > 0 && value !== valueBeside(line.textContent, own, step - 1) ? " changed" : ""}`,
                x: isOutput ? x - 4 : x + width + 4, y: Number(line.getAttribute("y")) - 1,
                "text-anchor": isOutput ? "end" : "start",
            }, shortened(value, MOST_BESIDE)));
        }
    }

    /** Moves values up or down from arrows and their labels, those of a box together. */
    settle() {
        const svg = this.element.querySelector("svg"), origin = svg?.getBoundingClientRect();
        if (!origin?.width) return;
        const { marks, lines } = this.obstacles ??= obstacles(svg, origin);
        const written = [];
        for (const { group } of this.boxes) {
            const texts = [...group.querySelectorAll(".of-net")], places = texts.map(text => within(text.getBoundingClientRect(), origin));
            const farthest = texts.length > 1 ? FARTHEST.several : FARTHEST.single;
            const near = all => all.filter(it => places.some(place => meets(cut(place, -farthest), it)));
            // A line that cannot be avoided is less than a head or a label.
            const [heads, all] = [near([...written, ...marks]), near([...written, ...marks, ...lines])];
            const isFree = (shift, gap, taken) => !places.some(place => taken.some(it => meets(cut(moved(place, shift), gap), it)));
            const choices = [all, heads].flatMap(taken => GAPS.map(gap => shifts(farthest).find(shift => isFree(shift, gap, taken))));
            const shift = choices.find(it => it !== undefined) ?? 0;
            texts.forEach(text => text.setAttribute("y", Number(text.getAttribute("y")) + shift));
            written.push(...places.map(place => cut(moved(place, shift), GAPS.at(-1))));
        }
    }
}
