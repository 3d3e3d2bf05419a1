"use strict";

/** The most characters of a value beside a box. */
const MOST_BESIDE = 10;

/** The block diagram of a unit. Its boxes have the values of their nets, and open the units that they stand for. */
class Diagram {
    constructor({ chosen, opened }) {
        Object.assign(this, { chosen, opened, boxes: [] });
        this.element = make("div", { className: "diagram-of-unit scroll" });
    }

    /** Puts the diagram in the page, and finds its boxes by the names in their titles. */
    place(svg, nets, units) {
        this.element.innerHTML = svg;
        const known = new Set(nets.map(({ name }) => name));
        const titles = [...this.element.querySelectorAll("g > title")];
        this.boxes = titles.map(title => this.box(title, known, units)).filter(({ names, units }) => names.length + units.length > 0);
        this.boxes.forEach(box => this.connect(box));
    }

    box(title, known, units) {
        const members = title.textContent.split("\n");
        // An array has a unit for each of its lanes.
        const of = member => units.filter(({ name }) => name === member || name.startsWith(`${member}[`));
        const lanes = name => [...known].filter(it => it.startsWith(`${name}[`));
        const names = members.flatMap(name => known.has(name) ? [name] : lanes(name));
        return { title, group: title.parentElement, members, names, units: members.flatMap(of) };
    }

    connect(box) {
        const { group, units, names } = box;
        const act = () => units.length > 0 ? this.opened(units[0]) : this.chosen(names);
        group.classList.add(units.length > 0 ? "box-of-units" : "box-of-nets");
        group.setAttribute("tabindex", 0);
        group.setAttribute("role", "button");
        group.addEventListener("click", act);
        group.addEventListener("keydown", event => {
            if (event.key !== "Enter" && event.key !== " ") return;
            event.preventDefault();
            event.stopPropagation();
            act();
        });
    }

    /** Frames the boxes whose nets changed, and writes their values beside them. */
    draw(nets, step, chosen) {
        for (const box of this.boxes) {
            const { group, title, names, members, units } = box;
            const own = nets.filter(({ name }) => names.includes(name));
            group.classList.toggle("changed", own.some(net => isChanged(net, step)));
            group.classList.toggle("asked", own.some(net => net.asked));
            group.classList.toggle("chosen", chosen !== null && chosen.join() === names.join());
            const said = members.map(name => {
                const net = own.find(it => it.name === name);
                return net ? `${name} = ${valueAt(net, step)}` : name;
            });
            title.textContent = said.join("\n");
            group.setAttribute("aria-label", units.length > 0 ? `Open ${members.join(", ")}` : `List the nets ${said.join(", ")}`);
            this.write(box, own, step);
        }
    }

    /** Writes the values of a box beside its names; where these stand for others, too, nothing. */
    write({ group, members }, own, step) {
        group.querySelectorAll(".of-net").forEach(it => it.remove());
        const lines = [...group.querySelectorAll("text.name")], outline = group.querySelector(".box:not(.behind)");
        if (!outline || own.length === 0) return;
        const { x, width } = outline.getBBox();
        // Ports on the right get their values where the arrows come in.
        const isOutput = outline.classList.contains("port") && group.ownerSVGElement.getBBox().width / 2 < x;
        members.slice(0, lines.length).forEach((member, number) => {
            const net = own.find(({ name }) => name === member);
            if (!net) return;
            const text = shape("text", {
                class: `of-net${isChanged(net, step) ? " changed" : ""}`,
                x: isOutput ? x - 4 : x + width + 4, y: Number(lines[number].getAttribute("y")) - 1,
                "text-anchor": isOutput ? "end" : "start",
            }, shortened(valueAt(net, step), MOST_BESIDE));
            group.append(text);
        });
    }
}
