// The field in which the user types keeps its text: an answer only updates the other fields.

let typed = null;
addEventListener("input", ({ target }) => (typed = target), true);
for (const over of ["change", "focusout"]) addEventListener(over, () => (typed = null), true);

export function put(field, value) {
  if (field !== typed) field.value = value;
}
