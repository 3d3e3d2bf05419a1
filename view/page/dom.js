"use strict";

/** The element of that id. */
const at = id => document.getElementById(id);

/** A new element with attributes and children. */
const make = (tag, attributes = {}, ...children) => {
    const element = document.createElement(tag);
    for (const [name, value] of Object.entries(attributes)) {
        if (name in element && name !== "list") element[name] = value;
        else element.setAttribute(name, value);
    }
    element.append(...children);
    return element;
};

/** Fills a list with choices: pairs of a value and its name. */
const choose = (select, choices, value) => {
    const kept = value ?? select.value;
    select.replaceChildren(...choices.map(([value, name]) => make("option", { value }, name)));
    if (choices.some(([value]) => value === kept)) select.value = kept;
};

/** A square in a colour. */
const swatch = colour => {
    const square = make("span", { className: "swatch" });
    square.style.background = colour;
    return square;
};

const css = ([red, green, blue]) => `rgb(${red} ${green} ${blue})`;

/** A whole number with groups of digits. */
const whole = number => Math.round(number).toLocaleString("en");

/** Picoseconds as a time that is read easily. */
const time = picoseconds => {
    const [unit, of] = [["ms", 1e9], ["µs", 1e6], ["ns", 1e3]].find(([, of]) => picoseconds >= of) ?? ["ns", 1e3];
    return `${(picoseconds / of).toFixed(unit === "ns" ? 0 : 3)} ${unit}`;
};
