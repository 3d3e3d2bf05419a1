"use strict";

/** The most nets in a wave at a time. */
const MOST_IN_WAVE = 40;

/** A unit of a circuit clock by clock: its diagram, the values of its nets, and their wave. Units inside of it can be opened. */
class Circuit {
    /** `ask` gives the data of a unit by its number, and `heading` is the level of headings. */
    constructor(ask, heading) {
        Object.assign(this, { ask, step: 0, chosen: null, data: null, known: "" });
        const title = text => make(heading, {}, text);
        const button = (className, label, text, act) => {
            const element = make("button", { className, "aria-label": label }, text);
            element.addEventListener("click", act);
            return element;
        };
        this.trail = make("nav", { className: "trail bar", "aria-label": "Units" });
        this.problem = make("p", { className: "bad", role: "alert" });
        this.about = make("p", { className: "hint" });
        this.diagram = new Diagram({ chosen: names => this.choose(this.chosen?.join() === names.join() ? null : names), opened: unit => this.open(unit.number) });
        this.hint = make("p", { className: "hint" });
        this.wave = new Wave(step => this.go(step));
        this.values = new Values();
        this.clock = make("input", { type: "number", className: "clock", min: 0, step: 1 });
        this.now = make("span", { className: "present", role: "status" });
        this.time = make("input", { type: "range", className: "time", min: 0, step: 1, "aria-label": "Clock of the run" });
        this.filter = make("input", { type: "search", className: "filter", placeholder: "part of a name", size: 16 });
        this.all = button("all", "Show all nets", "Show all nets", () => this.choose(null));
        this.deck = make("div", { className: "deck" },
            make("div", { className: "bar", role: "group", "aria-label": "Time" },
                button("first", "To the beginning", "|◀", () => this.go(0)),
                button("back", "A clock back", "◀ Step", () => this.go(this.step - 1)),
                button("step main", "A clock forward", "Step ▶", () => this.go(this.step + 1)),
                button("last", "To the end", "▶|", () => this.go(Infinity)),
                make("label", {}, "Clock ", this.clock), this.now),
            this.time);
        this.waves = make("section", {}, title("Wave"), make("p", { className: "hint" }, "Click a clock to go there. A box or a part of a name chooses other nets than the ports."), this.wave.element);
        this.element = make("div", { className: "circuit" }, this.trail, this.problem, this.about,
            make("section", {}, title("Diagram"), this.hint, this.diagram.element), this.waves,
            make("section", {}, title("Values"), make("div", { className: "bar" }, make("label", {}, "Nets ", this.filter), this.all), this.values.element),
            this.deck);
        this.time.addEventListener("input", () => this.go(Number(this.time.value)));
        this.clock.addEventListener("change", () => this.go(Math.floor(Number(this.clock.value)) - (this.data.first ?? 0)));
        this.filter.addEventListener("input", () => this.draw());
        this.resized = () => this.data && this.draw();
        addEventListener("resize", this.resized);
    }

    /** Shows the unit of that number, at the present clock unless another one is given. */
    async open(number, step = null) {
        const ticket = this.ticket = Symbol(number);
        const data = await this.ask(number).catch(error => {
            if (ticket === this.ticket) this.problem.textContent = error.message;
        });
        if (!data || ticket !== this.ticket) return;
        this.problem.textContent = "";
        // Another unit may count another clock.
        const time = this.data?.times[this.step] ?? 0;
        const same = data.times.findLastIndex(it => it <= time);
        Object.assign(this, { data, chosen: null });
        this.filter.value = "";
        this.place();
        this.go(step ?? data.step ?? Math.max(0, same));
    }

    /** Goes to the unit around this one. */
    leave() {
        const outer = this.data?.outer.at(-1);
        if (outer) this.open(outer.number); else this.problem.textContent = "";
    }

    /** Puts what the unit has in the page. */
    place() {
        const { diagram, narrow, nets, units, times, summary, source, first = 0 } = this.data;
        this.isNarrow = innerWidth < 700;
        this.diagram.place(this.isNarrow ? narrow : diagram, nets, units);
        const hints = [times.length > 1 ? "What changed at this clock is framed." : "", "Click a box to list its nets alone.",
            units.length > 0 ? "Click a unit to open it." : ""];
        this.hint.textContent = hints.filter(it => it).join(" ");
        // What the page says of its block stands in its head, and not here again.
        this.about.textContent = summary === this.known ? `The source is ${source}.` : `${summary} (${source})`;
        this.waves.hidden = this.deck.hidden = times.length < 2;
        this.time.max = times.length - 1;
        [this.clock.min, this.clock.max] = [first, first + times.length - 1];
        this.placeTrail();
    }

    /** The units around the present one, and its siblings if it is in an array. */
    placeTrail() {
        const { outer, name, siblings } = this.data;
        const way = outer.map(({ name, number }) => {
            const back = make("button", { title: `Back to ${name}` }, name);
            back.addEventListener("click", () => this.open(number));
            return back;
        });
        const here = siblings.length > 1 ? make("select", { "aria-label": "Unit of the array" }) : make("strong", {}, name);
        if (siblings.length > 1) {
            choose(here, siblings.map(it => [String(it.number), it.name]), String(siblings.find(it => it.name === name).number));
            here.addEventListener("change", () => this.open(Number(here.value)));
        }
        here.setAttribute("aria-current", "true");
        const parts = [...way, here].flatMap((it, place) => place > 0 ? ["›", it] : [it]);
        this.trail.replaceChildren(...parts);
        this.trail.hidden = outer.length === 0;
    }

    go(step) {
        this.step = Math.min(Math.max(step || 0, 0), this.data.times.length - 1);
        this.draw();
    }

    choose(names) {
        this.chosen = names;
        this.draw();
    }

    /** The nets that the reader wants to see. */
    wanted() {
        const text = this.filter.value.trim().toLowerCase();
        return this.data.nets.filter(({ name }) => (!this.chosen || this.chosen.includes(name)) && name.toLowerCase().includes(text));
    }

    /** The nets of the wave: the ports and what was asked about, unless the reader wants others. */
    waved() {
        const isWish = this.chosen || this.filter.value.trim();
        return (isWish ? this.wanted() : this.data.nets.filter(({ port, asked }) => port || asked)).slice(0, MOST_IN_WAVE);
    }

    draw() {
        const { data, step, chosen } = this, { times, first = 0 } = data;
        if (this.isNarrow !== innerWidth < 700) this.place();
        this.values.draw(data, this.wanted(), step);
        this.diagram.draw(data.nets, step, chosen);
        if (times.length > 1) this.wave.draw(data, this.waved(), step);
        [this.time.value, this.clock.value] = [step, first + step];
        this.now.textContent = `of ${whole(first + times.length - 1)}, ${time(times[step])}`;
        this.all.hidden = !chosen;
    }

    /** Takes the keys that are pressed in it, before those of the page. */
    listen() {
        this.element.addEventListener("keydown", event => actOnKey(this.keys(), event) && event.stopPropagation());
    }

    /** It is shown no more. */
    close() {
        removeEventListener("resize", this.resized);
    }

    /** Keys that move in it: [key, its name, what it does, action]. */
    keys() {
        return [
            ["ArrowRight", "→", "a clock forward", () => this.go(this.step + 1)],
            ["ArrowLeft", "←", "a clock back", () => this.go(this.step - 1)],
            ["Shift+ArrowRight", "Shift →", "ten clocks forward", () => this.go(this.step + 10)],
            ["Shift+ArrowLeft", "Shift ←", "ten clocks back", () => this.go(this.step - 10)],
            ["Home", "Home", "to the beginning", () => this.go(0)],
            ["End", "End", "to the end", () => this.go(Infinity)],
            ["/", "/", "search a net", () => this.filter.focus()],
            ["Backspace", "Backspace", "to the unit around this one", () => this.leave()],
        ];
    }
}
