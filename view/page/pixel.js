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
    return make("div", { className: "scroll" }, ...more, table);
};

/** The parts of what is known of a pixel, in the sequence of the page. */
const PIXEL_PARTS = [written];

/** Shows what is known of a pixel on each of some machines. */
const tellPixel = (panels, pixel, go) => {
    at("pixel-title").textContent = pixel ? `The pixel in column ${pixel.x}, row ${pixel.y}` : "A pixel";
    at("pixel-hint").hidden = !!pixel;
    const of = panel => make("div", {}, make("h3", {}, panel.machine.name), ...PIXEL_PARTS.map(part => part(panel, pixel, go)));
    at("known").classList.toggle("several", panels.length > 1);
    at("known").replaceChildren(...(pixel ? panels.filter(panel => panel.film).map(of) : []));
};
