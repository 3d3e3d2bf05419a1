"use strict";

/** The circuit that the page is about. */
const block = new Circuit(number => load(`unit/${number}`, "", () => {}), "h2");

const main = async () => {
    document.title = `Tilewright: ${ABOUT.title}`;
    at("title").textContent = ABOUT.title;
    at("summary").textContent = ABOUT.summary;
    at("scenario").textContent = `The run: ${ABOUT.scenario}.${ABOUT.left_out ? " Its end is left out." : ""}`;
    block.known = ABOUT.summary;
    at("circuit").append(block.element);
    connectKeys([...block.keys(), ["Escape", "Esc", "show all nets", () => block.choose(null)]]);
    await block.open(0);
};

main();
