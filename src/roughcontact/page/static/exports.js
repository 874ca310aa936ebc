// Files that the server writes: for the load, for the curve, or all in one archive.

import { request } from "./wire.js";

const KINDS = { csv: "CSV", nc: "NetCDF", png: "PNG", svg: "SVG" };

// `load()` and `curve()` return the current jobs.
export function exports(root, { load, curve, source, say, failed }) {
  const group = (label, of) => {
    const made = Object.assign(document.createElement("optgroup"), { label });
    made.append(...Object.entries(KINDS).map(([kind, name]) => new Option(name, of === "load" ? kind : `${of} ${kind}`)));
    return made;
  };
  root.replaceChildren(new Option("Export", ""), group("This load", "load"), group("The curve", "curve"), new Option("All, as ZIP", "zip"));

  root.onchange = async ({ target }) => {
    const [kind, of] = target.value.split(" ").reverse();
    target.value = "";
    if (!kind) return;
    if (!source()) return say("There is nothing to export yet: drop a file, or choose an example.");
    // The front worker holds the current load, the back worker the curve.
    const queue = kind === "zip" || of === "curve" ? "back" : "front";
    if (of === "curve" && !curve()) return say("There is no curve to export yet: press Start.");
    const [job, beside] = of === "curve" ? [curve()] : [load(), kind === "zip" ? curve() : null];
    const sent = request(queue, "export", job, { kind, beside }, (header, data) => {
      if (header.type === "progress" && header.state === "started") say(`${header.task} …`);
      if (header.type !== "file") return;
      const link = Object.assign(document.createElement("a"), { href: URL.createObjectURL(new Blob([data])), download: header.name });
      link.click();
      URL.revokeObjectURL(link.href);
      say(`${header.name} is saved.`);
    });
    try {
      const end = await sent.ended;
      if (end.message) say(end.message);
    } catch (error) {
      failed(error);
    }
  };
}
