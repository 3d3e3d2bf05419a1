"use strict";

/** The most steps that are listed at first. */
const MOST_STEPS = 120;

/** The way of a pixel through a machine: a sentence, the primitives, and the steps. `go` goes to a time, and `look` to the block of a step. */
const wayParts = (way, { go, look }) => {
    const { shown, golden, identical, failed, primitives, steps } = way;
    const verdict = shown === null ? "The machine showed no frame." : identical ? "The pixel is as in the golden image." : "The pixel is NOT as in the golden image.";
    const words = make("p", { className: "words" }, ...(shown === null ? [] : ["shown ", ...pixelWord(shown), ", "]), "golden ", ...pixelWord(golden));
    const parts = [make("p", { className: identical ? "good" : "bad", tabIndex: -1 }, verdict), words];
    if (failed) parts.push(make("p", { className: "bad" }, failed));
    parts.push(primitiveList(primitives), make("p", {}, difference(way)));
    if (steps.length > 0) parts.push(...stepTable(way, go, look));
    return parts;
};

/** A word of a pixel: its colour and its depth. */
const pixelWord = word => {
    const colour = word.slice(-6);
    return [swatch(`#${colour}`), `#${colour}`, ` depth ${word.slice(0, -6)}`];
};

const primitiveList = primitives => {
    if (primitives.length === 0) return make("p", {}, "No primitive covers the pixel.");
    const word = word => word === null ? "nothing" : word;
    const item = ({ name, golden, hardware, visible }) => make("li", {}, visible ? make("strong", {}, name) : name, ": ", make("code", {}, word(hardware)),
        ...(hardware === golden ? [] : [make("span", { className: "bad" }, " (golden: ", make("code", {}, word(golden)), ")")]), visible ? ", visible" : "");
    const count = primitives.length === 1 ? "1 primitive covers the pixel:" : `${primitives.length} primitives cover the pixel:`;
    return make("div", {}, make("p", {}, count), make("ul", { className: "primitives" }, ...primitives.map(item)));
};

/** The sentence on the first difference. */
const difference = ({ first_difference: first, steps }) => {
    if (!first) return "No step differs from its model.";
    const { unit, does } = steps[first.step];
    return `The first difference is in ${first.block}${first.source ? ` (${first.source})` : ""}: ${unit} ${does}.`;
};

/** The steps by time: what each unit did, and the hardware's values beside the model's. */
const stepTable = (way, go, look) => {
    const head = ["clock", "step", "value", "hardware", "model"];
    const heads = head.map(name => make("th", { scope: "col" }, name));
    const body = make("tbody", {}), table = make("table", { className: "steps" }, make("thead", {}, make("tr", {}, ...heads)), body);
    const rows = way.steps.map((step, number) => stepRow(way, step, number, go, look));
    // A difference is never hidden.
    const most = Math.max(MOST_STEPS, (way.first_difference?.step ?? 0) + 1);
    body.append(...rows.slice(0, most));
    const hint = make("p", { className: "hint" }, "A step opens its block at that clock.");
    if (rows.length <= most) return [hint, make("div", { className: "scroll" }, table)];
    const more = make("button", {}, `Show all ${rows.length} steps`);
    more.addEventListener("click", () => {
        body.append(...rows.slice(most));
        more.remove();
    });
    return [hint, make("div", { className: "scroll" }, table), more];
};

const stepRow = (way, step, number, go, look) => {
    const { unit, does, clock, cycle, picoseconds, primitive, values, differs } = step;
    const isFirst = way.first_difference?.step === number;
    const jump = make("button", { className: "jump", title: "Go to this time in the frame" }, `${clock} ${whole(cycle)}`);
    jump.addEventListener("click", () => go(picoseconds));
    const open = make("button", { className: "look" }, make("strong", {}, unit), ` ${does}`);
    open.addEventListener("click", () => look(number));
    const name = way.primitives.length > 1 && way.primitives.find(it => it.number === primitive)?.name;
    const lines = part => values.map(value => make("div", { className: value.differs ? "bad" : "" }, part(value) ?? "–"));
    const cells = [[jump, make("div", { className: "when" }, time(picoseconds))],
        [...(isFirst ? [make("span", { className: "mark" }, "first difference")] : []), open, ...(name ? [make("div", { className: "when" }, name)] : [])],
        lines(({ what }) => what), lines(({ hardware }) => hardware), lines(({ model }) => model)];
    const row = make("tr", { className: `${differs ? "differs" : ""}${isFirst ? " first" : ""}` }, ...cells.map(cell => make("td", {}, ...cell)));
    row.dataset.step = number;
    return row;
};
