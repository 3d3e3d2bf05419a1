// What is wrong with a page whatever it shows, a sentence for each.
(() => {
    const faults = [];
    const page = document.scrollingElement;
    if (page.scrollWidth > innerWidth) faults.push(`the page is ${page.scrollWidth} pixels wide in a window of ${innerWidth}`);
    for (const control of document.querySelectorAll("button, input, select, canvas[role=img]")) {
        const labelled = (control.getAttribute("aria-labelledby") ?? "").split(" ").map(id => document.getElementById(id)?.textContent ?? "");
        const names = [control.getAttribute("aria-label"), ...labelled, ...[...control.labels ?? []].map(it => it.textContent),
            control.tagName === "BUTTON" ? control.textContent : ""];
        if (!names.some(name => name?.trim())) faults.push(`a control has no name: ${control.outerHTML.slice(0, 80)}`);
    }
    const [red, green, blue] = getComputedStyle(document.body).backgroundColor.match(/[\d.]+/g).map(Number);
    const isDark = matchMedia("(prefers-color-scheme: dark)").matches;
    if ((0.2126 * red + 0.7152 * green + 0.0722 * blue < 128) !== isDark) faults.push("the background does not follow the scheme");
    const ids = [...document.querySelectorAll("[id]")].map(({ id }) => id);
    for (const id of new Set(ids.filter((id, place) => ids.indexOf(id) !== place))) faults.push(`two elements are called ${id}`);
    return faults;
})()
