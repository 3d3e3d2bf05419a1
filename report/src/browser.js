// Measures the pages in the frames of a probe, and writes what it finds into its page.
addEventListener("load", () => {
    const look = frame => {
        const page = frame.contentDocument, inside = frame.contentWindow;
        // The colour that a page without one has is that of the frame around it.
        const colour = inside.getComputedStyle(page.body).backgroundColor.match(/[\d.]+/g).map(Number);
        return {
            width: inside.innerWidth,
            scroll_width: page.scrollingElement.scrollWidth,
            is_empty: page.body.innerText.trim() === "",
            pictures_missing: [...page.images].filter(image => !(image.complete && image.naturalWidth)).length,
            loads: inside.performance.getEntriesByType("resource").map(entry => entry.name),
            prefers_dark: inside.matchMedia("(prefers-color-scheme: dark)").matches,
            brightness: (0.2126 * colour[0] + 0.7152 * colour[1] + 0.0722 * colour[2]) / 255,
        };
    };
    document.querySelector("pre").textContent = JSON.stringify([...document.querySelectorAll("iframe")].map(look));
});
