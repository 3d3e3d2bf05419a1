"use strict";

/** The value of a net at a clock. */
const valueAt = ({ changes }, step) => {
    let [low, high] = [0, changes.length];
    while (low < high) {
        const middle = low + high >> 1;
        if (changes[middle][0] <= step) low = middle + 1; else high = middle;
    }
    return low > 0 ? changes[low - 1][1] : "";
};

const isChanged = (net, step) => step > 0 && valueAt(net, step) !== valueAt(net, step - 1);

/** A value of at most so many characters. */
const shortened = (text, most) => text.length <= most ? text : `${text.slice(0, Math.max(1, most - 1))}…`;

/** A name of at most so many characters: names of one record differ at their ends. */
const shortenedName = (name, most) => {
    const kept = Math.max(2, most - 1), head = Math.floor(kept / 3);
    return name.length <= kept + 1 ? name : `${name.slice(0, head)}…${name.slice(name.length - kept + head)}`;
};

/** The part of a window that names take at most, and pixels of a character of one; its cell has so many more. */
const NAMES = { part: 0.45, letter: 8.9, padding: 20 };

/** Clocks that are shown beside the present one, on wide and on narrow windows. */
const BESIDE = { wide: 4, narrow: 1 };

/** The values of nets around a clock, with their source lines. */
class Values {
    constructor() {
        this.head = make("thead");
        this.body = make("tbody");
        this.element = make("div", { className: "scroll" }, make("table", { className: "nets" }, this.head, this.body));
    }

    /** Shows the nets at that step; the first clocks of a run that has a past have the number `first`. */
    draw({ times, first = 0 }, nets, step) {
        const beside = times.length < 2 ? 0 : innerWidth < 700 ? BESIDE.narrow : BESIDE.wide;
        const shown = Array.from({ length: 2 * beside + 1 }, (_, place) => step - beside + place);
        const heads = shown.map(it => make("th", { scope: "col", className: "number" }, it in times ? whole(first + it) : ""));
        this.head.replaceChildren(make("tr", {}, make("th", { scope: "col" }, "net"), ...heads, make("th", { scope: "col" }, "source")));
        this.body.replaceChildren(...nets.map(net => this.row(net, shown.map(it => it in times ? it : null), step)));
    }

    row(net, shown, step) {
        const cells = shown.map(it => make("td", {
            className: `value${it === step ? " now" : ""}${it !== null && isChanged(net, it) ? " changed" : ""}`,
            title: it === null ? "" : valueAt(net, it),
        }, it === null ? "" : valueAt(net, it)));
        const most = Math.floor((NAMES.part * innerWidth - NAMES.padding) / NAMES.letter);
        const name = make("th", { scope: "row", title: net.name, "aria-label": net.name }, shortenedName(net.name, most));
        const row = make("tr", {}, name, ...cells, make("td", {}, make("code", {}, net.source ?? "")));
        row.classList.toggle("asked", !!net.asked);
        return row;
    }
}
