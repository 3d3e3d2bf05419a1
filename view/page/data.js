"use strict";

/** Milliseconds between two questions whether data are made. The program waits for them, too. */
const AGAIN = 20;

/** What is thrown to ask no more. */
class Stopped extends Error {}

/** The data of a name. A server that is still making them tells what it does. */
const load = (name, query, told) => IS_EXPORTED ? loadScript(name) : ask(name, query, told);

const ask = async (name, query, told) => {
    for (;;) {
        const answer = await fetch(`data/${name}?${query}`).catch(() => {
            throw new Error("the server does not answer: start tilewright view again");
        });
        if (answer.status === 200) return answer.json();
        if (answer.status === 422) throw new Error((await answer.json()).sentence);
        if (answer.status !== 202) throw new Error(`the server answers with ${answer.status}`);
        told(await answer.json());
        await new Promise(done => setTimeout(done, AGAIN));
    }
};

/** A page without a server has its data in scripts. */
const loadScript = name => new Promise((done, failed) => {
    if (name in EXPORTED) return done(EXPORTED[name]);
    const fail = () => failed(new Error(`data/${name}.js is missing beside this page`));
    const script = make("script", { src: `data/${name}.js` });
    script.onload = () => name in EXPORTED ? done(EXPORTED[name]) : fail();
    script.onerror = fail;
    document.head.append(script);
});

/** Columns of numbers of 32 bits, which the program compressed. */
const unpack = async (text, count) => {
    const packed = Uint8Array.from(atob(text), letter => letter.charCodeAt(0));
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
    const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
    const rows = bytes.length / (4 * count);
    return Array.from({ length: count }, (_, number) => {
        const part = weight => bytes.subarray((4 * number + weight) * rows, (4 * number + weight + 1) * rows);
        const [a, b, c, d] = [0, 1, 2, 3].map(part);
        return Uint32Array.from(a, (low, row) => low | b[row] << 8 | c[row] << 16 | d[row] << 24);
    });
};
