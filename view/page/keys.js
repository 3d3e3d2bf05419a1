"use strict";

/** Connects keys to actions, and lists them. Each is [key, its name, what it does, action]. */
const connectKeys = keys => {
    at("keys").replaceChildren(...keys.flatMap(([, name, what]) =>
        [make("dt", {}, make("kbd", {}, name)), make("dd", {}, what)]));
    addEventListener("keydown", event => actOnKey(keys, event));
};

/** Does what a key means, if it means something here. */
const actOnKey = (keys, event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return false;
    // A control that is in use has keys of its own.
    const { tagName, type } = event.target;
    const takes = tagName === "SELECT" || tagName === "INPUT" && !(type === "checkbox" && event.key !== " ");
    if (takes || tagName === "BUTTON" && [" ", "Enter"].includes(event.key)) return false;
    const name = event.shiftKey && event.key.length > 1 ? `Shift+${event.key}` : event.key;
    const found = keys.find(([key, , , act]) => act && (key === name || key === name.toLowerCase()));
    if (!found) return false;
    event.preventDefault();
    found[3]();
    return true;
};
