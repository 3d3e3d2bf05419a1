"use strict";

/** Connects keys to actions, and lists them. Each is [key, its name, what it does, action]. */
const connectKeys = keys => {
    at("keys").replaceChildren(...keys.flatMap(([, name, what]) =>
        [make("dt", {}, make("kbd", {}, name)), make("dd", {}, what)]));
    addEventListener("keydown", event => {
        if (event.ctrlKey || event.metaKey || event.altKey) return;
        // A control that is in use has keys of its own.
        const { tagName, type } = event.target;
        const takes = tagName === "SELECT" || tagName === "INPUT" && !(type === "checkbox" && event.key !== " ");
        if (takes || tagName === "BUTTON" && [" ", "Enter"].includes(event.key)) return;
        const name = event.shiftKey && event.key.length > 1 ? `Shift+${event.key}` : event.key;
        const found = keys.find(([key]) => key === name || key === name.toLowerCase());
        if (!found) return;
        event.preventDefault();
        found[3]();
    });
};
