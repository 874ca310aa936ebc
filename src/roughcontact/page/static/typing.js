// What is being typed stays: an answer that comes meanwhile shows its value in every other field.

let typed = null;
addEventListener("input", ({ target }) => (typed = target), true);
for (const over of ["change", "focusout"]) addEventListener(over, () => (typed = null), true);

export function put(field, value) {
  if (field !== typed) field.value = value;
}
