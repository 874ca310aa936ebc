"""How long the page lets its user wait: the table of docs/how-to/page.md, measured in a real browser.

python benchmarks/page.py --repeats 9        needs the extras `page` and `browser`, a Chromium, and a quiet machine
python benchmarks/page.py --picture FILE     draws docs/images/page.png instead

The clock is that of the browser. It starts with what the user does (a file is dropped, the slider is moved) and stops
with the picture that the answer gives; for what is cancelled, with the request and the end of the answer.
"""

from __future__ import annotations

import argparse
import base64
import shutil
import signal
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from statistics import median
from typing import Any

import numpy as np
from playwright.sync_api import Page, sync_playwright

import roughcontact as rc

PATIENCE = 300_000  # milliseconds
# Until the map holds a field anew, and is on the screen.
SHOWN = """(field, start, act) => new Promise((resolve) => {
  const canvas = document.getElementById("map");
  const watch = new MutationObserver(() => {
    if (!(canvas.dataset.fields || "").includes(field)) return;
    watch.disconnect();
    requestAnimationFrame(() => resolve(performance.now() - start));
  });
  watch.observe(canvas, { attributes: true, attributeFilter: ["data-fields"] });
  act();
})"""
DROP = f"""([name, text]) => {{
  const data = new DataTransfer();
  data.items.add(new File([Uint8Array.from(atob(text), (c) => c.charCodeAt(0))], name));
  const drop = new DragEvent("drop", {{ dataTransfer: data, bubbles: true, cancelable: true }});
  return ({SHOWN})("heights", performance.now(), () => document.getElementById("drop").dispatchEvent(drop));
}}"""
SLIDE = f"""(step) => {{
  const slider = document.getElementById("slider");
  slider.value = String(Number(slider.value) + step);
  return ({SHOWN})("pressure", performance.now(), () => {{
    for (const type of ["input", "change"]) slider.dispatchEvent(new Event(type, {{ bubbles: true }}));
  }});
}}"""
IDLE = """() => document.getElementById("view").getAttribute("aria-busy") === "false"
  && (document.getElementById("map").dataset.fields || "").includes("gap")"""
# From the request to stop to the end of the answer; from the next one to its map.
CANCEL = """async ([long, short]) => {
  const { session } = await (await fetch("/session", { method: "POST" })).json();
  const request = async (key, asked) => (await fetch(`/request?session=${session}`,
    { method: "POST", body: JSON.stringify({ ...asked, queue: "front", key, more: {} }) })).body.getReader();
  const words = new TextDecoder();
  const until = async (reader, found) => {
    for (let read = await reader.read(); !read.done; read = await reader.read()) {
      if (found && words.decode(read.value).includes(found)) return;
    }
  };
  const first = await request("1", long);
  await until(first, "Looking");
  await new Promise((resolve) => setTimeout(resolve, 1000)); // into the middle of the work
  const asked = performance.now();
  fetch(`/stop?session=${session}&queue=front&key=1`, { method: "POST" });
  await until(first, null);
  const over = performance.now();
  const second = await request("2", short);
  await until(second, '"map":"pressure"');
  const there = performance.now();
  await until(second, null);
  await fetch(`/end?session=${session}`, { method: "POST" });
  return [over - asked, there - over];
}"""


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--repeats", type=int, default=9)
    parser.add_argument("--picture", type=Path)
    options = parser.parse_args()
    repeats = options.repeats
    with served() as address, opened(address) as page:
        if options.picture:
            return portray(page, options.picture)
        rows = [
            (
                "first map after the drop of a file, 1024 x 1024",
                2.0,
                [drop(page, 1024) for _ in range(repeats)],
            ),
            ("slider to new map, 1024 x 1024", 1.0, slides(page, repeats)),
        ]
        drop(page, 512)
        rows.append(("slider to new map, 512 x 512", 0.3, slides(page, repeats)))
        ends, nexts = zip(*(cancel(page) for _ in range(repeats)), strict=True)
        rows.append(("end of a solve that is cancelled, 1024 x 1024", 0.2, ends))
        rows.append(("from there to the next map, 512 x 512", 1.0, nexts))
    print("| what | goal [s] | median [s] | longest [s] |\n|---|---|---|---|")
    for what, goal, times in rows:
        print(f"| {what} | {goal} | {median(times):.2f} | {max(times):.2f} |")


def portray(page: Page, file: Path) -> None:
    """Draw the page with a contact and its curve."""
    page.locator("#example").select_option(index=3)
    settled(page)
    page.locator("[data-map=contact]").click()
    page.locator("#start").click()
    page.wait_for_function("() => !document.getElementById('stop').disabled")
    page.wait_for_function("() => document.getElementById('stop').disabled")
    page.locator("#map").hover(position={"x": 300, "y": 250})
    settled(page)
    page.mouse.move(0, 0)
    page.locator("#curves summary", has_text="Points").click()  # whose table would be cut off
    page.evaluate("() => scrollTo(0, 0)")
    end = page.locator("#curve").bounding_box()
    assert end is not None
    page.screenshot(
        path=file,
        full_page=True,
        clip={"x": 0, "y": 0, "width": 1400, "height": end["y"] + end["height"] + 20},
    )


@contextmanager
def served() -> Iterator[str]:
    """Yield the address of a page."""
    command = [sys.executable, "-m", "roughcontact", "serve", "--no-browser"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True) as process:
        assert process.stdout is not None
        yield process.stdout.readline().strip()
        process.send_signal(signal.SIGINT)


@contextmanager
def opened(address: str) -> Iterator[Page]:
    """Yield the page in a browser."""
    place = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
    with sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=place, args=["--no-sandbox"])
        page = browser.new_page(viewport={"width": 1400, "height": 1000})
        page.set_default_timeout(PATIENCE)
        page.goto(address)
        page.locator("#example option").nth(1).wait_for(state="attached")
        drop(page, 256)  # nobody's first map waits for the start of the program
        settled(page)
        yield page
        browser.close()


def drop(page: Page, points: int) -> float:
    """Return the time from the drop of a file to its map [s]."""
    page.wait_for_timeout(500)
    surface = rc.self_affine(rc.Grid((points, points), 1e-6), 0.8, 1e-6, np.random.default_rng(points))
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, f"map{points}.npz")
        rc.write(surface, file)
        text = base64.b64encode(file.read_bytes()).decode()
    return float(page.evaluate(DROP, [file.name, text])) / 1e3


def slides(page: Page, repeats: int) -> list[float]:
    """Return the times from a move of the slider to the map of the pressure [s], once nothing else is computed."""
    times = []
    for number in range(repeats):
        settled(page)
        times.append(float(page.evaluate(SLIDE, -9 if number % 2 else 12)) / 1e3)
    settled(page)
    return times


def cancel(page: Page) -> tuple[float, float]:
    """Return the times from a request to stop to the end of the answer, and from there to the next map [s]."""

    def made(points: int) -> dict[str, Any]:
        return {"kind": "self-affine", "hurst": "0.8", "rms": "1um", "size": "1mm", "points": str(points)}

    page.wait_for_timeout(6000)  # in which the server has another process ready
    bodies, load = {"modulus": "100GPa"}, {"pressure": "10 MPa"}
    long = {"job": "curve", "recipe": {"job": "curve", "source": made(1024), "bodies": bodies}}
    short = {"job": "press", "recipe": {"job": "press", "source": made(512), "bodies": bodies, "load": load}}
    end, there = page.evaluate(CANCEL, [long, short])
    return end / 1e3, there / 1e3


def settled(page: Page) -> None:
    """Wait until the load is computed, and what is computed when there is time as well."""
    while not page.evaluate(IDLE):
        page.wait_for_timeout(20)
    page.wait_for_timeout(3000)


if __name__ == "__main__":
    main()
