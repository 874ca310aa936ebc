"""The site's own search, asked in a browser: the page that answers comes first.

python docs/search_check.py BUILT_SITE [QUESTION]      without a question those below are asked, and must be answered
"""

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from shutil import which
from threading import Thread
from urllib.parse import urlencode

QUESTIONS = {
    "stiffness per area": "concepts/joints",
    "shear of an interface": "concepts/joints-shear",
    "slip and damping per area": "concepts/joints-shear",
    "thermal contact": "tutorials/thermal",
    "hysteretic friction": "concepts/sliding-hysteresis",
    "friction against speed": "gallery/friction/rubber_friction",
    "current of each spot": "gallery/bodies/spot_currents",
    "measured stiffness of a joint": "how-to/infer-joint",
    "read a .sur file": "how-to/files",
    "my curve is unresolved": "how-to/unresolved",
    "which cut-off": "gallery/questions/short_cutoff",
    "crest at the border": "evidence/law-cut",
    "gpu": "how-to/devices",
    "jax": "how-to/autograd",
    "abaqus": "coming-from/abaqus",
    "calculix": "coming-from/calculix",
    "freecad": "coming-from/calculix",
    "table for other codes": "how-to/interface-tables",
    "tamaas": "coming-from/tamaas",
    "aspher": "coming-from/aspher",
    "benchmark": "evidence/benchmark-suite",
    "how good are the tests": "evidence/tests",
    "contact.engineering": "coming-from/contactmechanics",
    "tip radius": "how-to/afm",
    "pint": "how-to/units",
    "why unresolved": "how-to/unresolved",
    "leak": "how-to/leaks",
    "tangential stiffness": "tutorials/friction",
    "damping of an interface": "how-to/shear",
    "bolted joint": "how-to/joint",
    "tilting stiffness": "how-to/joint",
    "viscoelastic": "concepts/time",
    "viscoelastic contact in time": "concepts/time",
    "creep": "how-to/creep",
    "rubber": "how-to/viscoelastic",
    "creep of a rough rubber contact": "gallery/rubber/rough_rubber_block",
    "rubber friction": "concepts/sliding-hysteresis",
    "leak against time": "tutorials/rubber-seal",
    "damping of a bolted joint from measured faces": "tutorials/bolted-joint",
    "mated": "reference/glossary",
    "K from ultrasound": "how-to/ultrasound",
    "mpi": "how-to/scale",
    "friction loop": "tutorials/friction",
    "periodic or free": "gallery/bodies/periodic_and_free",
    "adhesion": "how-to/adhesion",
    "afm tip": "how-to/afm",
    "method of adhesion": "concepts/method-adhesion",
    "derivatives": "how-to/derivatives",
    "memory": "how-to/memory",
    "couple to finite elements": "how-to/coupling",
    "hardness": "concepts/plastic",
    "unload and reload": "how-to/plastic-loops",
    "prepare a surface": "how-to/preparing",
    "shift of two faces": "how-to/preparing",
    "many maps of one surface": "how-to/many-measurements",
    "how spectra are combined": "concepts/many-maps",
    "what stiffness shows of a surface": "concepts/what-stiffness-shows",
    "how spikes are recognised": "concepts/spikes",
    "json output": "reference/json-output",
    "joint known by two numbers": "how-to/specified",
    "how many threads": "how-to/threads",
    "tab key": "how-to/completion",
    "shell completion": "how-to/completion",
    "check the installation": "how-to/doctor",
    "report a defect": "how-to/doctor",
    "progress in a notebook": "how-to/progress",
    "how far is a long job": "how-to/progress",
    "press": "api/roughcontact.press",
    "papers to cite": "how-to/citing",
    "design a joint": "gallery/derivatives/design_a_joint",
    "tilt of a pin": "gallery/derivatives/worn_pin",
    "inverse problem": "gallery/derivatives/worn_pin",
    "ehl": "gallery/lubrication/line_contact",
    "elastohydrodynamic": "gallery/lubrication/line_contact",
    "squeeze film": "gallery/lubrication/squeeze_film",
    "sealing lip": "gallery/bodies/sealing_lip",
    "body of revolution": "gallery/bodies/sealing_lip",
    "moving grid": "gallery/bodies/four_sums",
    "viscous body": "gallery/rubber/viscous_mould",
    "all claims of the thesis": "evidence/reproduction-claims",
    "the figures of the thesis": "evidence/reproduction-figures",
}
FIRST = 8  # pages of an answer that are waited for and printed
BROWSERS = ("chromium", "chromium-browser", "google-chrome")


@contextmanager
def served(folder: Path) -> Iterator[str]:
    """Serve a folder to this machine, and give its address."""
    handler = partial(QuietHandler, directory=str(folder))
    with ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
        server.handle_error = lambda *_: None  # a browser that leaves a page before it has all of it
        Thread(target=server.serve_forever, daemon=True).start()
        try:
            yield f"http://127.0.0.1:{server.server_port}/"
        finally:
            server.shutdown()


class QuietHandler(SimpleHTTPRequestHandler):
    """One that writes no log."""

    def log_message(self, *_: object) -> None:
        """Say nothing."""


@contextmanager
def browser() -> Iterator:
    """Start a Chromium: the system's, or the one that playwright has fetched.

    Raises
    ------
    LookupError
        If there is none.
    """
    try:
        from playwright.sync_api import Error, sync_playwright
    except ImportError:
        raise LookupError("playwright is not installed") from None
    with sync_playwright() as playwright:
        system = next(filter(None, map(which, BROWSERS)), None)
        try:
            # Root, as in containers, has no sandbox; their shared memory is small.
            arguments = ["--no-sandbox", "--disable-dev-shm-usage"]
            chromium = playwright.chromium.launch(executable_path=system, args=arguments)
        except Error as error:
            raise LookupError(str(error).splitlines()[0]) from None
        yield chromium
        chromium.close()


def answers(page, site: str, question: str) -> list[str]:
    """Return the first pages that the search lists, the best one first."""
    page.goto(f"{site}search.html?{urlencode({'q': question})}")
    listed = page.locator("ul.search li > a")
    # The search fetches every page that it lists, and writes its summary only after the last one.
    listed.nth(FIRST - 1).or_(page.locator("p.search-summary:not(:empty)")).first.wait_for()
    links = listed.evaluate_all("all => all.map(a => new URL(a.href).pathname)")
    return list(dict.fromkeys(link.removeprefix("/").removesuffix(".html") for link in links))


def main(folder: Path, *questions: str) -> str | None:
    """Ask, print what is found, and return what is wrong."""
    wrong = []
    try:
        with served(folder) as site, browser() as chromium:
            page = chromium.new_page()
            elsewhere = []
            page.on("request", lambda request: elsewhere.append(request.url))
            for question in questions or QUESTIONS:
                found = answers(page, site, question)
                if questions:
                    print(*found[:FIRST], sep="\n")  # noqa: T201
                elif found[:1] != [QUESTIONS[question]]:
                    wrong.append(f"{question!r} finds {found[:3]}, not {QUESTIONS[question]}")
            wrong += [f"a page asks {url}" for url in elsewhere if not url.startswith((site, "data:"))]
    except LookupError as error:
        print(f"docs: the search was not asked, there is no Chromium: {error}")  # noqa: T201
    return "\n".join(wrong) or None


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]), *sys.argv[2:]))
