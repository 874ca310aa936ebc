// Commands and Python with a button that copies them.

export function statement(pre) {
  const button = Object.assign(document.createElement("button"), { type: "button", className: "copy", textContent: "Copy" });
  button.setAttribute("aria-label", `Copy: ${pre.getAttribute("aria-label")}`);
  const box = Object.assign(document.createElement("div"), { className: "statement" });
  pre.replaceWith(box);
  box.append(pre, button);
  button.onclick = async () => {
    try {
      await navigator.clipboard.writeText(pre.textContent);
      button.textContent = "Copied";
    } catch {
      getSelection().selectAllChildren(pre); // the clipboard is not accessible: select the text for Ctrl-C
      button.textContent = "Selected";
    }
    setTimeout(() => (button.textContent = "Copy"), 1500);
  };
  return (text) => (pre.textContent = text);
}
