"use strict";

/** The newest pixels are those of this share of the frame's time. */
const NEWEST = 0.01;
/** Pixels that a finger or a mouse moves before a click becomes a drag. */
const STEADY = 6;

/** The keys that move a pixel on the picture, each with columns and rows. */
const MOVES = [["ArrowLeft", -1, 0], ["ArrowRight", 1, 0], ["ArrowUp", 0, -1], ["ArrowDown", 0, 1]]
    .flatMap(([key, x, y]) => [[key, x, y], [`Shift+${key}`, 10 * x, 10 * y]]);

/** A machine's picture with its overlays. */
class Panel {
    constructor(machine, { clicked, dragged, moved }) {
        Object.assign(this, { machine, film: null, clock: 0, took: Infinity });
        const image = (className, label) => make("canvas", { className, role: label ? "img" : "presentation", "aria-label": label ?? "" });
        this.canvas = image("picture", `The frame on ${machine.name}`);
        this.over = image("over");
        this.grid = make("div", { className: "grid" });
        this.boxes = make("canvas", { className: "boxes", role: "presentation", hidden: true });
        this.spot = make("div", { className: "spot", hidden: true });
        this.wait = make("div", { className: "wait", role: "status" });
        const keys = `Picture of ${machine.name}: arrow keys move a pixel, Enter asks why it has its colour`;
        this.stage = make("div", { className: "stage", tabIndex: 0, role: "group", "aria-label": keys }, this.canvas, this.over, this.grid, this.boxes, this.spot, this.wait);
        this.verdict = make("span");
        this.laid = make("div", { className: "laid hint", hidden: true });
        this.element = make("figure", {}, make("figcaption", {}, make("strong", {}, machine.name), this.verdict), this.stage, this.laid);
        this.point(clicked, dragged);
        const own = [...MOVES.map(([key, x, y]) => [key, "", "", () => moved(this, x, y)]), ["Enter", "", "", () => clicked(this, null)]];
        this.stage.addEventListener("keydown", event => actOnKey(own, event) && event.stopPropagation());
    }

    /** Loads the frame, and says what is being done for it. */
    async load(query, loaded) {
        this.query = query;
        const begin = performance.now();
        const ticket = this.ticket = Symbol(query);
        try {
            this.say("asking for the frame");
            const picture = await load(`frame/${this.machine.name}`, query, it => ticket === this.ticket && this.say(it.what, it.done));
            const film = await Film.of(picture);
            if (ticket !== this.ticket) return;
            this.took = performance.now() - begin;
            this.show(film);
            loaded(this);
        } catch (error) {
            if (ticket !== this.ticket) return;
            this.wait.replaceChildren(make("span", { className: "bad" }, error.message));
            this.wait.hidden = false;
        }
    }

    say(what, done) {
        const bar = make("progress", { max: 1, "aria-label": `Progress on ${this.machine.name}` });
        if (typeof done === "number") bar.value = done;
        this.wait.replaceChildren(make("span", {}, `${what} …`), bar);
        this.wait.hidden = false;
    }

    show(film) {
        const { size: [width, height], identical, verdict } = film.picture;
        this.film = film;
        this.painter = new Painter(film, this.canvas, this.over);
        this.stage.style.aspectRatio = `${width} / ${height}`;
        // Below the whole height of a window, so that the controls stay in it.
        this.stage.style.setProperty("--shape", width / height);
        this.stage.classList.add("has-picture");
        this.wait.hidden = true;
        this.verdict.replaceChildren(verdict);
        this.verdict.className = identical ? "good" : "bad";
    }

    /** Draws the picture at a clock. */
    draw(clock, { paint, fresh, overlay }) {
        if (!this.film) return;
        if (this.paint !== paint || this.painted !== this.film) {
            [this.paint, this.painted] = [paint, this.film];
            this.painter.paintAs(paint);
        }
        this.clock = clock;
        this.painter.seek(this.film.until(clock));
        this.painter.highlight(fresh ? this.film.until(clock - Math.ceil(this.film.end * NEWEST)) : this.painter.at);
        this.painter.draw();
        this.layGrid(overlay === "grid" ? this.film.picture.grids[0] : null);
        this.layAreas(overlay === "areas" && !!this.machine.areas);
    }

    /** Lays what the units work on over the picture, once it has been loaded. */
    layAreas(isWanted) {
        this.boxes.hidden = this.laid.hidden = !isWanted;
        if (!isWanted) return;
        if (this.areasOf !== this.film) {
            this.areasOf = this.film;
            this.areas = null;
            this.loadAreas(this.film);
        }
        if (!this.areas) return;
        const count = this.areas.draw(this.boxes, this.film, this.clock);
        const legend = this.areas.levels > 0 ? [" Levels: ", ...this.areas.legend()] : [];
        this.laid.replaceChildren(`${whole(count)} ${this.areas.name}.`, ...legend);
    }

    async loadAreas(film) {
        const tell = it => this.areasOf === film && this.laid.replaceChildren(`Drawing again for them: ${it.what} …`);
        try {
            tell({ what: "asking" });
            const areas = await Areas.of(await load(`areas/${this.machine.name}`, this.query, tell));
            if (this.areasOf !== film) return;
            this.areas = areas;
            this.layAreas(!this.boxes.hidden);
        } catch (error) {
            if (this.areasOf === film) this.laid.replaceChildren(make("span", { className: "bad" }, error.message));
        }
    }

    layGrid(grid) {
        this.grid.hidden = !grid;
        if (!grid) return;
        const [width, height] = this.film.picture.size;
        const line = "rgb(255 255 255 / .45) 1px, transparent 1px";
        this.grid.style.backgroundImage = `linear-gradient(to right, ${line}), linear-gradient(to bottom, ${line})`;
        this.grid.style.backgroundSize =
            `${this.stage.clientWidth * grid.size[0] / width}px ${this.stage.clientHeight * grid.size[1] / height}px`;
    }

    /** Marks a pixel. */
    mark(pixel) {
        this.spot.hidden = !pixel || !this.film;
        if (this.spot.hidden) return;
        const [width, height] = this.film.picture.size;
        this.spot.style.left = `${100 * (pixel.x + 0.5) / width}%`;
        this.spot.style.top = `${100 * (pixel.y + 0.5) / height}%`;
    }

    /** Tells clicks and drags. */
    point(clicked, dragged) {
        let begin = null;
        this.stage.addEventListener("pointerdown", event => {
            begin = { x: event.clientX, moved: false };
            this.stage.setPointerCapture(event.pointerId);
        });
        this.stage.addEventListener("pointermove", event => {
            if (!begin || !this.film) return;
            begin.moved ||= Math.abs(event.clientX - begin.x) > STEADY;
            if (begin.moved) dragged((event.clientX - begin.x) / this.stage.clientWidth, false);
        });
        this.stage.addEventListener("pointercancel", () => begin = null);
        this.stage.addEventListener("pointerup", event => {
            if (!begin || !this.film) return;
            const { x, moved } = begin;
            begin = null;
            if (moved) return dragged((event.clientX - x) / this.stage.clientWidth, true);
            const box = this.canvas.getBoundingClientRect(), [width, height] = this.film.picture.size;
            const inside = (value, size) => Math.min(Math.max(Math.floor(value), 0), size - 1);
            clicked(this, {
                x: inside((event.clientX - box.left) / box.width * width, width),
                y: inside((event.clientY - box.top) / box.height * height, height),
            });
        });
    }
}
