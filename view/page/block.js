"use strict";

/** Clocks that are shown beside the present one, on wide and on narrow windows. */
const BESIDE = { wide: 4, narrow: 1 };

const block = { data: null, step: 0, chosen: null };

/** The value of a net at a clock. */
const valueAt = ({ changes }, step) => {
    let [low, high] = [0, changes.length];
    while (low < high) {
        const middle = low + high >> 1;
        if (changes[middle][0] <= step) low = middle + 1; else high = middle;
    }
    return low > 0 ? changes[low - 1][1] : "";
};

const isChanged = (net, step) => step > 0 && valueAt(net, step) !== valueAt(net, step - 1);

/** The nets that the reader wants to see. */
const wanted = () => {
    const text = at("filter").value.trim().toLowerCase();
    return block.data.nets.filter(({ name }) => (!block.chosen || block.chosen.includes(name)) && name.toLowerCase().includes(text));
};

const go = step => {
    block.step = Math.min(Math.max(step, 0), block.data.times.length - 1);
    draw();
};

const drawNets = () => {
    const { data: { times }, step } = block;
    const beside = innerWidth < 700 ? BESIDE.narrow : BESIDE.wide;
    const shown = Array.from({ length: 2 * beside + 1 }, (_, place) => step - beside + place);
    const heads = shown.map(it => make("th", { scope: "col", className: "number" }, it in times ? whole(it) : ""));
    at("nets").tHead.replaceChildren(make("tr", {}, make("th", { scope: "col" }, "net"), ...heads, make("th", { scope: "col" }, "source")));
    const row = net => {
        const cells = shown.map(it => make("td", {
            className: `value${it === step ? " now" : ""}${it in times && isChanged(net, it) ? " changed" : ""}`,
            title: it in times ? valueAt(net, it) : "",
        }, it in times ? valueAt(net, it) : ""));
        return make("tr", {}, make("th", { scope: "row" }, net.name), ...cells, make("td", {}, make("code", {}, net.source ?? "")));
    };
    at("nets").tBodies[0].replaceChildren(...wanted().map(row));
};

/** Frames the boxes whose nets changed, and says their values where the mouse rests. */
const drawDiagram = () => {
    for (const { group, title, names } of block.boxes) {
        const nets = block.data.nets.filter(({ name }) => names.includes(name));
        group.classList.toggle("changed", nets.some(net => isChanged(net, block.step)));
        group.classList.toggle("chosen", block.chosen === names);
        title.textContent = names.map(name => {
            const net = nets.find(it => it.name === name);
            return net ? `${name} = ${valueAt(net, block.step)}` : name;
        }).join("\n");
    }
};

const draw = () => {
    const { data: { times }, step } = block;
    drawNets();
    drawDiagram();
    [at("time").value, at("clock").value] = [step, step];
    at("now").textContent = `of ${whole(times.length - 1)}, ${time(times[step])}`;
    at("all").hidden = !block.chosen;
};

const chooseNets = names => {
    block.chosen = names;
    draw();
};

/** Puts the diagram in the page, and finds its boxes by the nets in their titles. */
const placeDiagram = svg => {
    at("diagram").innerHTML = svg;
    const known = new Set(block.data.nets.map(({ name }) => name));
    block.boxes = [...at("diagram").querySelectorAll("g > title")].map(title => ({ title, group: title.parentElement, names: title.textContent.split("\n") }))
        .filter(({ names }) => names.some(name => known.has(name)));
    for (const { group, names } of block.boxes) {
        group.classList.add("box-of-nets");
        group.addEventListener("click", () => chooseNets(block.chosen === names ? null : names));
    }
};

const main = async () => {
    document.title = `Tilewright: ${ABOUT.title}`;
    at("title").textContent = ABOUT.title;
    at("summary").textContent = ABOUT.summary;
    at("scenario").textContent = `The run: ${ABOUT.scenario}.${ABOUT.left_out ? " Its end is left out." : ""}`;
    block.data = await load("block", "", () => {});
    placeDiagram(block.data.diagram);
    at("wave").append(make("img", { alt: "The wave of the ports", src: `data:image/svg+xml,${encodeURIComponent(block.data.wave)}` }));
    at("time").max = at("clock").max = block.data.times.length - 1;
    const actions = { first: () => go(0), back: () => go(block.step - 1), step: () => go(block.step + 1), last: () => go(Infinity) };
    for (const [id, act] of Object.entries(actions)) at(id).addEventListener("click", act);
    at("time").addEventListener("input", () => go(Number(at("time").value)));
    at("clock").addEventListener("change", () => go(Math.floor(Number(at("clock").value))));
    at("filter").addEventListener("input", draw);
    at("all").addEventListener("click", () => chooseNets(null));
    addEventListener("resize", draw);
    connectKeys([
        ["ArrowRight", "→", "a clock forward", actions.step],
        ["ArrowLeft", "←", "a clock back", actions.back],
        ["Shift+ArrowRight", "Shift →", "ten clocks forward", () => go(block.step + 10)],
        ["Shift+ArrowLeft", "Shift ←", "ten clocks back", () => go(block.step - 10)],
        ["Home", "Home", "to the beginning", actions.first],
        ["End", "End", "to the end", actions.last],
        ["/", "/", "search a net", () => at("filter").focus()],
        ["Escape", "Esc", "show all nets", () => chooseNets(null)],
    ]);
    draw();
};

main().catch(error => at("scenario").replaceChildren(make("span", { className: "bad" }, error.message)));
