"use strict";

/** The block of a step of a pixel's way, at that clock. */
const moment = {
    circuit: null,
    ticket: null,

    /** Shows the block at a step. */
    async look(why, step, number) {
        const ticket = this.ticket = Symbol(number);
        at("moment").hidden = false;
        at("moment-title").textContent = `${step.unit}, ${step.clock} ${whole(step.cycle)}`;
        at("moment-step").textContent = `The ${step.unit} ${step.does}: ${step.values.map(valueOf).join(", ")}.`;
        at("moment-note").textContent = "";
        this.circuit?.close();
        this.circuit = null;
        const bar = make("progress", { max: 1, "aria-label": "Progress of the wave" }), said = make("span", {}, "asking");
        at("moment-circuit").replaceChildren(make("div", { className: "bar", role: "status" }, said, bar));
        at("moment").scrollIntoView({ block: "start" });
        at("moment-title").focus({ preventScroll: true });
        const tell = ({ what, done }) => {
            if (ticket !== this.ticket) throw new Stopped();
            said.textContent = `Drawing again for the wave: ${what} …`;
            if (typeof done === "number") bar.value = done; else bar.removeAttribute("value");
        };
        const name = why.name.replace(/^way/, "moment");
        const ask = unit => load(name, `${why.query}&step=${number}&unit=${unit}`, tell);
        try {
            this.show(await ask(0), ask, ticket);
        } catch (error) {
            if (ticket === this.ticket) at("moment-circuit").replaceChildren(make("p", { className: "bad", role: "alert" }, error.message));
        }
    },

    show({ note, path, unit }, ask, ticket) {
        if (ticket !== this.ticket) return;
        at("moment-note").textContent = note ? `${note[0].toUpperCase()}${note.slice(1)}.` : `The unit ${path || "at the top"} in the machine that drew this frame.`;
        if (!unit) return at("moment-circuit").replaceChildren();
        this.circuit = new Circuit(async number => (await ask(number)).unit, "h3");
        at("moment-circuit").replaceChildren(this.circuit.element);
        this.circuit.listen();
        this.circuit.open(0);
    },

    /** Shows no block. */
    leave() {
        this.ticket = null;
        this.circuit?.close();
        this.circuit = null;
        at("moment").hidden = true;
    },
};

const valueOf = ({ what, hardware, model, differs }) => `${what} ${hardware}${differs ? ` (model: ${model})` : ""}`;
