// Keys for the whole page: undo and redo, except in text fields, which have their own.

const TEXT = "input:not([type=range]):not([type=checkbox]):not([type=file]), textarea";

export function shortcuts({ undo, redo, leave }) {
  document.addEventListener("keydown", (event) => {
    if (event.key === "Escape") return leave();
    if (!(event.ctrlKey || event.metaKey) || event.altKey || event.target.matches(TEXT)) return;
    const key = event.key.toLowerCase();
    const again = key === "y" || (key === "z" && event.shiftKey);
    if (!again && key !== "z") return;
    event.preventDefault();
    (again ? redo : undo)();
  });
}
