"use strict";

/** The choice of all machines side by side. */
const ALL = "all";

const view = { panels: [], pixel: null, lanes: new Map(), turn: 0 };
const playing = new Playing(() => draw());

/** The pictures that have been loaded. */
const loaded = () => view.panels.filter(panel => panel.film);
/** Picoseconds of the longest frame. */
const longest = () => Math.max(1, ...loaded().map(({ film }) => film.end * film.period));
const isOwnPace = () => view.panels.length > 1 && at("pace").value === "own";
/** The time of a clock, from 0 to 1, and back. */
const shareOf = ({ film }, clock) => isOwnPace() ? clock / film.end : clock * film.period / longest();
const clockOf = ({ film }, share) =>
    Math.min(film.end, Math.floor((isOwnPace() ? share * film.end : share * longest() / film.period) + 1e-6));

/** Draws all at the present time. */
const draw = () => {
    const options = { paint: at("paint").value, fresh: at("fresh").checked, overlay: at("grid").value };
    for (const panel of loaded()) {
        panel.draw(clockOf(panel, playing.share), options);
        view.lanes.get(panel)?.draw(panel.clock);
        panel.mark(view.pixel);
    }
    at("time").value = playing.share;
    at("speed").value = playing.seconds;
    const name = playing.isPlaying ? "Pause" : "Play";
    if (at("play").textContent !== name) {
        at("play").textContent = name;
        at("play").setAttribute("aria-label", name);
    }
    const now = loaded().map(({ film, machine, clock }) =>
        `${view.panels.length > 1 ? `${machine.name}: ` : ""}clock ${whole(clock)} of ${whole(film.end)}, ${time(clock * film.period)}`);
    at("now").textContent = now.join(" · ");
    at("time").setAttribute("aria-valuetext", now.join("; "));
    if (!playing.isPlaying) tellPixel(view.panels, view.pixel, jump);
};

/** Goes to a clock of a picture. */
const jump = (panel, clock) => {
    playing.isPlaying = false;
    playing.go(shareOf(panel, clock));
};

/** Goes to the next change of a pixel, or to the one before. */
const step = forward => {
    const times = loaded().map(panel =>
        shareOf(panel, forward ? panel.film.after(panel.clock) : panel.film.ahead(panel.clock)));
    if (times.length === 0) return;
    playing.isPlaying = false;
    // A picture that has ended has no next change.
    const next = times.filter(share => forward ? share > playing.share : share < playing.share);
    playing.go(next.length === 0 ? Number(forward) : forward ? Math.min(...next) : Math.max(...next));
};

const choosePixel = pixel => {
    view.pixel = pixel;
    if (pixel) [at("x").value, at("y").value] = [pixel.x, pixel.y]; else moment.leave();
    playing.isPlaying = false;
    draw();
};

const middle = ({ film: { picture: { size } } }) => ({ x: size[0] >> 1, y: size[1] >> 1 });

/** Chooses a pixel, or takes the chosen one, and asks why it has its colour. */
const askPixel = (panel, pixel) => {
    if (!panel.film) return;
    choosePixel(pixel ?? view.pixel ?? middle(panel));
    askWhy(panel, view.pixel);
};

/** Moves the pixel by columns and rows, or begins in the middle. */
const movePixel = (panel, x, y) => {
    if (!panel.film) return;
    const [width, height] = panel.film.picture.size, inside = (value, size) => Math.min(Math.max(value, 0), size - 1);
    const { pixel } = view;
    choosePixel(pixel ? { x: inside(pixel.x + x, width), y: inside(pixel.y + y, height) } : middle(panel));
};

/** Shows the grids and units of the pictures that have been loaded. */
const arrived = panel => {
    const lanes = new Lanes(panel.film);
    view.lanes.set(panel, lanes);
    at("lanes").replaceChildren(...loaded().map(it => view.lanes.get(it).element));
    const grids = [...new Set(loaded().flatMap(({ film }) => film.picture.grids.map(({ name }) => name)))];
    const areas = view.panels.map(({ machine }) => machine.areas).filter(it => it);
    const overlays = [["grid", grids.join(", ")], ["areas", areas.join(", ")]].filter(([, name]) => name);
    at("grid-label").hidden = overlays.length === 0;
    choose(at("grid"), [["off", "none"], ...overlays]);
    const [width, height] = panel.film.picture.size;
    [at("x").max, at("y").max] = [width - 1, height - 1];
    draw();
};

/** Shows a machine, or all of them. */
const show = choice => {
    const machines = choice === ALL ? ABOUT.machines : ABOUT.machines.filter(({ name }) => name === choice);
    playing.pause();
    view.lanes.clear();
    at("lanes").replaceChildren();
    view.panels = machines.map(machine => new Panel(machine, { clicked: askPixel, dragged, moved: movePixel }));
    at("panels").classList.toggle("several", machines.length > 1);
    at("panels").replaceChildren(...view.panels.map(panel => panel.element));
    at("pace-label").hidden = machines.length < 2;
    at("summary").textContent = machines.length > 1 ? ABOUT.summary : machines[0].summary;
    at("machine").value = choice;
    return reload();
};

/** Loads the pictures for the present camera. */
const reload = () => Promise.all(view.panels.map(panel => panel.load(`turn=${view.turn}`, arrived)));

/** Turns the camera, and draws again. */
const turnTo = degrees => {
    const turn = (Math.round(degrees / 5) * 5 + 540) % 360 - 180;
    at("turn").value = turn;
    at("turned").textContent = `${turn}°`;
    if (turn === view.turn) return null;
    view.turn = turn;
    return reload();
};

/** A drag across the picture is half a circle. Where a frame takes long, the picture follows at the end. */
const dragged = (share, isOver) => {
    if (!ABOUT.orbits) return;
    view.dragged ??= view.turn;
    const degrees = view.dragged - 180 * share;
    const isQuick = view.panels.every(panel => panel.took < 1000);
    if (isOver) view.dragged = null;
    if (!isOver && (!isQuick || view.isTurning)) return;
    const turned = turnTo(degrees);
    view.isTurning = turned !== null;
    turned?.finally(() => view.isTurning = false);
};

/** Leaves the block of a step, or else the pixel. */
const leave = () => {
    if (!at("moment").hidden) return moment.leave();
    whys.forEach(it => it.stop());
    document.activeElement?.blur();
    choosePixel(null);
};

const cycle = select => {
    select.selectedIndex = (select.selectedIndex + 1) % select.options.length;
    draw();
};

const main = () => {
    document.title = `Tilewright: ${ABOUT.title}`;
    at("title").textContent = ABOUT.title;
    const several = ABOUT.machines.length > 1 ? [[ALL, "all, side by side"]] : [];
    choose(at("machine"), [...ABOUT.machines.map(({ name }) => [name, name]), ...several]);
    choose(at("paint"), Object.entries(PAINTS).map(([value, { name }]) => [value, name]));
    choose(at("speed"), SPEEDS.map(seconds => [String(seconds), `${seconds} s`]), "10");
    at("turn-label").hidden = !ABOUT.orbits;

    at("machine").addEventListener("change", () => show(at("machine").value));
    for (const id of ["paint", "grid", "fresh", "pace"]) at(id).addEventListener("change", draw);
    at("speed").addEventListener("change", () => playing.seconds = Number(at("speed").value));
    at("time").addEventListener("input", () => playing.go(Number(at("time").value)));
    at("turn").addEventListener("change", () => turnTo(Number(at("turn").value)));
    const actions = { first: () => playing.go(0), last: () => playing.go(1), play: () => playing.toggle(), step: () => step(true), back: () => step(false) };
    for (const [id, act] of Object.entries(actions)) at(id).addEventListener("click", act);
    at("place").addEventListener("submit", event => {
        event.preventDefault();
        const inside = id => Math.min(Math.max(Math.floor(Number(at(id).value)), 0), Number(at(id).max));
        const panel = loaded()[0];
        if (panel) askPixel(panel, { x: inside("x"), y: inside("y") });
    });
    addEventListener("resize", draw);

    const machineKeys = ABOUT.machines.map(({ name }, number) => [String(number + 1), String(number + 1), `show ${name}`, () => show(name)]);
    connectKeys([
        [" ", "Space", "play or pause", actions.play],
        ["ArrowRight", "→", "step to the clock of the next pixel", actions.step],
        ["ArrowLeft", "←", "step back", actions.back],
        ["Shift+ArrowRight", "Shift →", "a hundredth of the time forward", () => playing.go(playing.share + 0.01)],
        ["Shift+ArrowLeft", "Shift ←", "a hundredth of the time back", () => playing.go(playing.share - 0.01)],
        ["Home", "Home", "to the beginning", actions.first],
        ["End", "End", "to the end", actions.last],
        ["+", "+", "play faster", () => playing.change(1)],
        ["-", "−", "play slower", () => playing.change(-1)],
        ...machineKeys,
        ...(several.length > 0 ? [["a", "a", "show all machines side by side", () => show(ALL)]] : []),
        ["c", "c", "next colours", () => cycle(at("paint"))],
        ["g", "g", "next overlay: grid, windows, pages", () => at("grid-label").hidden || cycle(at("grid"))],
        ["n", "n", "highlight the newest pixels", () => { at("fresh").checked = !at("fresh").checked; draw(); }],
        ["", "↑ ↓ ← →", "on the picture: move the pixel, with Shift by ten"],
        ["", "Enter", "on the picture: why the pixel has its colour; again: stop"],
        ["Escape", "Esc", "leave the block of a step, then the pixel", leave],
    ]);
    show(ABOUT.first);
};

main();
