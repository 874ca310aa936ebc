// The text in place of the map: how to begin, the file that is being read, or an error.

const by = (id) => document.getElementById(id);
const BEGIN = ["Drop a measured surface anywhere", "X3P, SUR, OPD, Gwyddion, NetCDF, NumPy, text and the formats of most instruments. Or choose an example:"];

export function welcome(examples, open) {
  const buttons = examples.map((each) => {
    const made = { type: "button", textContent: each.name, title: each.about, onclick: () => open(each) };
    return Object.assign(document.createElement("button"), made);
  });
  const file = { type: "button", textContent: "Choose a file", onclick: () => by("file").click() };
  by("begin").append(Object.assign(document.createElement("button"), file), ...buttons);

  function show(title, text, beginning = false) {
    const root = by("welcome");
    root.hidden = false;
    root.querySelector("strong").textContent = title;
    root.querySelector("p").textContent = text;
    by("begin").hidden = !beginning;
  }
  show(...BEGIN, true);

  return {
    // A source was opened, or removed.
    of: (title) => (title ? show(`Reading ${title} …`, "") : show(...BEGIN, true)),
    refused: ({ message, places = [] }, title) => show(places.length ? `${title} needs your input` : `${title} cannot be shown`, message),
    done: () => (by("welcome").hidden = true),
  };
}
