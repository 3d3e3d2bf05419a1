"use strict";

/** The most changes of a pixel that are listed. */
const MOST_LISTED = 40;

/** Which unit wrote the pixel, at which clocks. */
const written = (panel, pixel, go) => {
    const { film, clock } = panel, { size: [width], units } = film.picture;
    const changes = film.changes(pixel.y * width + pixel.x);
    if (changes.length === 0) return make("p", {}, "No unit writes this pixel. It has the background's colour.");
    const head = ["clock", "time", "unit", "depth", "colour"];
    const current = changes.filter(i => film.clock[i] <= clock).at(-1);
    const rows = changes.slice(-MOST_LISTED).map(i => {
        const colour = film.colour[i], unit = units[film.unit[i]];
        const jump = make("button", { title: "Go to this clock" }, whole(film.clock[i]));
        jump.addEventListener("click", () => go(panel, film.clock[i]));
        const cells = [jump, time(film.clock[i] * film.period), [swatch(css(unit.colour)), unit.name], whole(film.depth[i]),
            [swatch(css([colour >> 16, colour >> 8 & 255, colour & 255])), `#${colour.toString(16).padStart(6, "0")}`]];
        const row = make("tr", { className: i === current ? "now" : film.clock[i] > clock ? "later" : "" },
            ...cells.map((cell, number) => make("td", { className: [0, 1, 3].includes(number) ? "number" : "" }, ...[cell].flat())));
        if (i === current) row.setAttribute("aria-current", "true");
        return row;
    });
    const cells = head.map((name, number) => make("th", { scope: "col", className: [0, 1, 3].includes(number) ? "number" : "" }, name));
    const table = make("table", {}, make("thead", {}, make("tr", {}, ...cells)), make("tbody", {}, ...rows));
    const more = changes.length > MOST_LISTED ? [make("p", { className: "hint" }, `The last ${MOST_LISTED} of ${changes.length} changes.`)] : [];
    return make("div", { className: "written scroll" }, ...more, table);
};

/** The parts of what is known of a pixel, in the sequence of the page. A part that has not changed is the element that it was. */
const PIXEL_PARTS = [written, why];

/** Shows what is known of a pixel on each of some machines. */
const tellPixel = (panels, pixel, go) => {
    at("pixel-title").textContent = pixel ? `The pixel in column ${pixel.x}, row ${pixel.y}` : "A pixel";
    at("pixel-hint").hidden = !!pixel;
    const known = pixel ? panels.filter(panel => panel.film) : [];
    at("known").classList.toggle("several", panels.length > 1);
    const places = known.map(panel => panel.known ??= make("div", {}, make("h3", {}, panel.machine.name), ...PIXEL_PARTS.map(() => make("div"))));
    if (places.length !== at("known").children.length || places.some((it, number) => it !== at("known").children[number])) at("known").replaceChildren(...places);
    known.forEach((panel, place) => PIXEL_PARTS.forEach((part, number) => {
        const old = places[place].children[number + 1], element = part(panel, pixel, go);
        if (element === old) return;
        // A button that was pressed keeps the focus in its place.
        const pressed = [...old.querySelectorAll("button")].indexOf(document.activeElement);
        old.replaceWith(element);
        if (pressed >= 0) element.querySelectorAll("button")[pressed]?.focus();
    }));
};
