"""The page under the hand of a person, in a real browser. Nothing waits for a time, all for what is to be seen."""

import base64
import csv
import io
import json
import re
import shlex
import threading
import time
import warnings
import zipfile
from dataclasses import dataclass
from functools import cached_property
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

import numpy as np
import psutil
import pytest
from typer.testing import CliRunner

import roughcontact as rc
from roughcontact.cli.app import app
from served import PATIENCE, ended, opened_again, started

pytestmark = pytest.mark.slow

SCREEN = {"width": 1400, "height": 1000}
DROP = """([name, text]) => {
  const data = new DataTransfer();
  data.items.add(new File([Uint8Array.from(atob(text), (c) => c.charCodeAt(0))], name));
  for (const type of ["dragenter", "dragover", "drop"]) {
    document.getElementById("drop").dispatchEvent(
      new DragEvent(type, { dataTransfer: data, bubbles: true, cancelable: true }));
  }
}"""
# How many colours the map shows, and a number that another picture changes.
PICTURE = """() => {
  const canvas = document.getElementById("map");
  const bytes = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data;
  const words = new Uint32Array(bytes.buffer);
  let sum = 17;
  for (const word of words) sum = (Math.imul(sum, 31) + word) | 0;
  return [new Set(words).size, sum];
}"""
# Names and values at once: the page may be about to change them.
FACTS = """() => {
  const texts = (kind) => [...document.querySelectorAll(`#facts ${kind}`)].map((each) => each.innerText);
  const values = texts("dd");
  return texts("dt").map((name, k) => [name, values[k]]);
}"""
POINTS = """() => {
  const words = document.getElementById("curve").getAttribute("aria-label") || "0 points";
  return Number(/(\\d+) points/.exec(words)[1]);
}"""


@dataclass
class Tab:
    """A page and what a person sees of it."""

    page: Any
    told: list  # errors of scripts, and requests to elsewhere

    def text(self, name):
        return self.page.locator(f"#{name}").text_content()  # folded away or not

    def wait(self, condition, argument=None):
        """Wait for a condition in the page; it is asked there, since each question from here costs much."""
        # The page's policy lets no function wait there that is given as words.
        asked = f"""async ([given, patience]) => {{
          const holds = {condition};
          for (const before = Date.now() + patience; Date.now() < before; ) {{
            if (holds(given)) return true;
            await new Promise((next) => setTimeout(next, 20));
          }}
          return false;
        }}"""
        assert self.page.evaluate(asked, [argument, 1000 * PATIENCE]), self.said(f"{condition} {argument}")

    def until(self, holds, what=""):
        """Wait until something holds."""
        before, pause = time.monotonic() + PATIENCE, 10.0
        while not holds():
            assert time.monotonic() < before, self.said(what)
            self.page.wait_for_timeout(pause)
            pause = min(1.5 * pause, 200)  # each look costs as much as a short pause

    def said(self, what):
        """Return what the page says while something does not hold."""
        return f"{what}: {self.text('said')!r} {self.text('curve_said')!r} {self.told}"

    def drop(self, name, content):
        """Drop a file, and wait for its map or for the reason why there is none."""
        self.page.evaluate(DROP, [name, base64.b64encode(content).decode()])
        self.wait(
            """(name) => {
              const by = (id) => document.getElementById(id);
              if (by("name").textContent !== name) return false;
              if ((by("map").dataset.fields || "").includes("heights")) return true;
              return by("view").getAttribute("aria-busy") === "false" && by("said").textContent !== "";
            }""",
            name,
        )
        return "heights" in (self.page.get_attribute("#map", "data-fields") or "")

    def example(self, name):
        """Choose an example by the beginning of its name."""
        options = self.page.locator("#example option").all_inner_texts()
        [label] = [each for each in options if each.startswith(name)]
        self.page.select_option("#example", label=label)

    def settled(self):
        """Wait until the maps and numbers of the load are there."""
        self.wait(
            """() => document.getElementById("view").getAttribute("aria-busy") === "false"
              && (document.getElementById("map").dataset.fields || "").includes("gap")"""
        )

    @property
    def facts(self):
        return dict(self.page.evaluate(FACTS))

    @property
    def picture(self):
        return self.page.evaluate(PICTURE)


@dataclass
class Desk:
    """A server and a browser that was given its address."""

    served: Any
    context: Any

    @cached_property
    def origin(self):
        return f"http://127.0.0.1:{self.served.port}"

    def tab(self):
        page, told = self.context.new_page(), []
        page.on("console", lambda line: told.append(line.text) if line.type == "error" else None)
        page.on("pageerror", lambda error: told.append(str(error)))
        page.on("request", lambda sent: self._elsewhere(sent.url) and told.append(sent.url))
        tab = Tab(page, told)
        self.show(tab)
        return tab

    def show(self, tab):
        """Show the page as in a new tab; in the same one its session goes on, whose processes are warm."""
        opened_again(tab.page, self.served.address)
        tab.page.locator("#example option").nth(1).wait_for(state="attached", timeout=1000 * PATIENCE)

    def _elsewhere(self, url):
        return not url.startswith((self.origin, "data:", "blob:"))


@pytest.fixture(scope="module")
def desk(chromium, tmp_path_factory):
    served = started(tmp_path_factory.mktemp("desk"))
    context = chromium.new_context(viewport=SCREEN, accept_downloads=True)
    yield Desk(served, context)
    context.close()
    ended(served)


@pytest.fixture(scope="module")
def opened(desk):
    return desk.tab()


@pytest.fixture
def tab(desk, opened):
    """A tab without files and settings, as a new one; its session may hold files of tests before."""
    desk.show(opened)
    opened.told.clear()
    yield opened
    assert opened.told == []


@pytest.fixture(scope="module")
def part(tmp_path_factory):
    """A measured file, as its bytes."""
    file = tmp_path_factory.mktemp("part") / "part.npz"
    rc.write(rc.self_affine(rc.Grid((64, 64), 1e-6), 0.8, 1e-7, np.random.default_rng(2)), file)
    return file.read_bytes()


def is_map(file):
    """Return whether the library reads a map from a file that says all by itself."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            rc.read(file)
        except ValueError:
            return False
    return True


def test_every_measured_file_gives_a_map_or_a_reason(tab, measured, part, tmp_path):
    if not measured:  # files of our own in their place
        (tmp_path / "part.npz").write_bytes(part)
        np.save(tmp_path / "bare.npy", np.random.default_rng(1).normal(size=(16, 16)))
        (tmp_path / "words.txt").write_text("no heights\n")
        measured = sorted(tmp_path.iterdir())
    shown = {}
    for file in measured:
        shown[file.name] = tab.drop(file.name, file.read_bytes())
        if shown[file.name]:
            tab.wait("() => document.getElementById('map').width > 0")
            assert tab.picture[0] > 5, file.name
        else:
            assert len(tab.text("said")) > 20, file.name
    assert shown == {file.name: is_map(file) for file in measured}


def test_the_slider_gives_a_new_map_and_new_numbers(tab):
    tab.example("Fractal patch")
    tab.settled()
    tab.page.get_by_role("button", name="Contact").click()
    facts, picture = tab.facts, tab.picture
    tab.page.locator("#slider").focus()
    for _ in range(5):
        tab.page.keyboard.press("ArrowRight")
    tab.settled()
    assert tab.facts.keys() == facts.keys()
    assert tab.facts != facts
    assert tab.picture != picture
    for _ in range(5):  # each press of the key is a step
        tab.page.locator("#undo").click()
    tab.settled()
    assert (tab.facts, tab.picture) == (facts, picture)


def test_a_load_that_is_written_is_the_one_that_is_pressed(tab, part):
    assert tab.drop("part.npz", part)
    tab.settled()
    tab.page.fill("#load", "2 MPa")
    tab.page.keyboard.press("Enter")
    tab.settled()
    assert tab.facts["nominal pressure"] == "2 MPa"
    assert "--pressure '2 MPa'" in tab.text("command")


def test_points_of_a_curve_arrive_and_stop(tab):
    tab.example("Joint face")
    tab.settled()
    tab.page.locator("#start").click()
    tab.wait(f"() => ({POINTS})() >= 2")
    tab.page.locator("#stop").click()
    tab.wait("() => document.getElementById('stop').disabled && !document.getElementById('start').disabled")
    count = tab.page.evaluate(POINTS)
    assert 2 <= count < 24
    # The load goes on as before.
    tab.page.locator("#slider").press("ArrowRight")
    tab.settled()


def test_the_flow_through_the_gap_stands_beside_the_curve(tab, part):
    """Chosen in the form of the curve; its columns in chart and table, and the load that closes the gap."""
    assert tab.drop("part.npz", part)
    tab.settled()
    tab.page.evaluate(
        "document.querySelectorAll('#curve_forms details').forEach((each) => (each.open = true))"
    )
    tab.page.select_option("[id='leak.leak']", "1")
    tab.page.locator("#start").click()
    tab.wait("() => document.getElementById('curve_facts').textContent.includes('open path')")
    assert "--leak 1" in tab.text("curve_command")
    header = tab.page.locator("#points thead").inner_text()
    assert all(name in header for name in ("hydraulic gap [", "transmissivity [", "flow factor", "open path"))
    tab.page.select_option("#quantity", "hydraulic_gap")
    assert tab.page.evaluate(POINTS) > 0


def test_a_solve_gives_way_to_what_is_asked_next(tab):
    """The map of what was asked last is shown, and no answer to what was asked before comes after it."""
    tab.example("Large map")
    tab.wait("() => document.getElementById('said').textContent.startsWith('Pressing')")
    tab.example("Fractal patch")
    tab.settled()
    assert tab.facts["surface"].startswith("256 x 256 cells")
    assert "--points 256" in tab.text("command")


def exported(tab, kind):
    """Return the name and the bytes of what the page gives away."""
    with tab.page.expect_download(timeout=1000 * PATIENCE) as waiting:
        tab.page.select_option("#export", kind)
    file = waiting.value.path()
    return waiting.value.suggested_filename, file.read_bytes()


def numbers_of(command):
    """Return what commands print as JSON, the last one's."""
    for line in command.splitlines():
        result = CliRunner().invoke(app, [*shlex.split(line)[1:], "--json"])
        assert result.exit_code == 0, result.stderr
    return json.loads(result.stdout)


def table_of(text):
    """Return the rows of a table in CSV, by the names of its columns without their units."""
    header, *rows = csv.reader(text.splitlines())
    return [dict(zip([title.partition(" [")[0] for title in header], row, strict=True)) for row in rows]


def test_what_is_exported_is_what_the_stated_command_prints(tab, part, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "part.npz").write_bytes(part)
    assert tab.drop("part.npz", part)
    tab.settled()
    name, content = exported(tab, "csv")
    [row] = table_of(content.decode())
    printed = numbers_of(tab.text("command"))
    assert re.fullmatch(r"part-pressure-[\d.]+[kM]?Pa-[0-9a-f]{6}\.csv", name)
    for key in ("force", "depth", "contact_area", "stiffness"):
        assert float(row[key]) == printed[key], key


def test_the_archive_holds_all_and_the_commands_that_make_it(tab, part, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "part.npz").write_bytes(part)
    assert tab.drop("part.npz", part)
    tab.settled()
    tab.page.locator("#start").click()
    tab.wait(f"() => ({POINTS})() >= 3")
    # Nothing is clicked if the curve has ended meanwhile.
    tab.page.evaluate("() => document.getElementById('stop').click()")
    tab.wait("() => document.getElementById('stop').disabled")
    _, content = exported(tab, "zip")
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        files = {name: archive.read(name) for name in archive.namelist()}
    assert {"press.csv", "pressure.nc", "pressure.png", "curve.csv", "commands.sh", "same.py"} <= files.keys()
    *_, press, curve = files["commands.sh"].decode().splitlines()
    assert json.loads(files["press.json"])["force"] == numbers_of(press)["force"]
    points = table_of(files["curve.csv"].decode())
    assert len(points) == tab.page.evaluate(POINTS)
    printed = numbers_of(curve)
    for key in ("force", "depth", "stiffness", "contact_area"):
        assert [float(each[key]) for each in points] == printed[key], key


def test_two_tabs_do_not_disturb_each_other(desk, tab):
    other = desk.tab()
    tab.example("Fractal patch")
    other.example("Joint face")
    tab.settled()
    other.settled()
    assert tab.facts["surface"].startswith("256 x 256 cells")
    assert other.facts["surface"].startswith("512 x 512 cells")
    facts = tab.facts
    other.page.locator("#slider").press("ArrowRight")
    other.settled()
    other.page.close()
    assert other.told == []
    assert tab.facts == facts
    tab.page.locator("#slider").press("ArrowRight")
    tab.settled()
    assert tab.facts != facts


def test_the_files_of_a_tab_go_with_it(desk, tab, part):
    before, other = desk.served.left(), desk.tab()
    assert tab.drop("part.npz", part)
    assert other.drop("other.npz", part)

    def new():
        return {path.name for path in desk.served.left() if path not in before}

    tab.until(lambda: new() == {"part.npz", "other.npz"})
    other.page.close(run_before_unload=True)
    tab.until(lambda: new() == {"part.npz"})


def test_a_worker_that_is_killed_is_said_and_replaced(desk, tab):
    tab.example("Large map")
    tab.wait("() => document.getElementById('said').textContent.startsWith('Pressing')")
    killed = desk.served.workers
    for worker in killed:
        worker.kill()
    tab.wait("() => document.getElementById('said').textContent.includes('A new one takes over')")
    # What is asked of a process before the server knows of its end is answered as above.
    assert psutil.wait_procs(killed, timeout=30)[1] == []
    tab.page.get_by_role("button", name="Compute again").click()
    tab.settled()
    assert tab.facts["surface"].startswith("1024 x 1024 cells")
    assert not tab.page.locator("#again").is_visible()


def test_the_example_that_is_open_is_computed_again_when_it_is_chosen_again(tab):
    tab.example("Fractal patch")
    tab.settled()
    tab.page.evaluate("() => (document.getElementById('facts').textContent = '')")
    tab.example("Fractal patch")
    tab.until(lambda: "nominal pressure" in tab.facts)
    assert not tab.page.locator("#undo").is_enabled()


def test_a_gigabyte_is_refused_before_it_is_sent(desk, tab, tmp_path):
    before, large = desk.served.left(), tmp_path / "large.x3p"
    with large.open("wb") as file:
        file.truncate(2**30)  # of which the disk holds nothing
    tab.page.set_input_files("#file", large)
    tab.wait("() => document.getElementById('said').textContent.includes('512 MB')")
    tab.until(lambda: {*desk.served.left()} <= {*before})


@pytest.fixture
def elsewhere():
    """The address of another site on this machine: another port, to which browsers send the same cookies."""

    class Silent(BaseHTTPRequestHandler):
        def do_GET(self):
            self.send_response(200)
            self.end_headers()

        def log_message(self, *_):
            pass

    with ThreadingHTTPServer(("127.0.0.1", 0), Silent) as site:
        threading.Thread(target=site.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{site.server_port}/"
        site.shutdown()


def test_another_site_in_the_same_browser_is_refused(desk, tab, elsewhere):
    """Though its requests bear the cookie; and the browser keeps from it that there is somebody."""
    sessions, failed = desk.served.sessions(), []
    page = desk.context.new_page()
    page.on("requestfailed", lambda found: failed.append(found.url))
    page.goto(elsewhere)
    for mode in ("cors", "no-cors"):
        page.evaluate(
            "([url, mode]) => fetch(url, {method: 'POST', mode, credentials: 'include'}).catch(() => null)",
            [f"{desk.origin}/session", mode],
        )
    tab.until(lambda: failed == [f"{desk.origin}/session"] * 2, failed)
    page.close()
    assert desk.served.sessions() <= sessions  # that of a tab that was closed before may have ended meanwhile


def test_an_address_without_its_key_opens_nothing(chromium, desk):
    context = chromium.new_context()
    page = context.new_page()
    assert page.goto(desk.origin).status == 403
    assert "contains the key" in page.locator("body").inner_text()
    context.close()


def test_the_address_keeps_no_key(tab):
    assert "token" not in tab.page.url
    assert tab.page.evaluate("document.cookie") == ""


def computed(tab, loads="", text="", kind="curve", **given):
    """Compute a curve by loads of a range or by what is given, and wait for its end."""
    tab.page.select_option("#kind", kind)
    if loads:
        tab.page.select_option("#loads", loads)
        given[f"loads.{loads}"] = text
    for name, value in given.items():
        tab.page.fill(f'[id="{name}"]', value)
    tab.page.locator("#start").click()
    tab.wait("() => document.getElementById('curve_facts').children.length > 0")
    tab.wait("() => !document.getElementById('start').disabled")


def test_a_row_of_the_points_shows_its_contact(tab, part):
    assert tab.drop("part.npz", part)
    tab.settled()
    computed(tab, "pressures", "1 MPa:4 MPa:3")
    assert tab.page.evaluate(POINTS) == 3
    assert "--pressures '1 MPa:4 MPa:3'" in tab.text("curve_command")
    tab.page.locator("#points button").nth(1).press("Enter")
    tab.settled()
    assert tab.facts["nominal pressure"] == "2 MPa"
    assert tab.facts["interfacial stiffness per area K/A0"].endswith("N/µm/mm²")
    assert "K/A0 [N/µm/mm²]" in tab.text("points")
    tab.wait("() => document.querySelector('#points tr[aria-current] button') === document.activeElement")


def test_a_late_stop_of_a_request_before_a_reload_stops_none_after_it(desk, tab, part):
    with tab.page.expect_request("**/request?*") as first:
        assert tab.drop("part.npz", part)
    tab.settled()
    asked = json.loads(first.value.post_data)
    stop = first.value.url.replace("/request?", "/stop?") + f"&queue={asked['queue']}&key={asked['key']}"
    assert tab.page.evaluate("async (url) => (await fetch(url, {method: 'POST'})).ok", stop)
    desk.show(tab)
    assert tab.drop("part.npz", part)
    tab.settled()


def test_a_theory_is_drawn_or_says_why_it_is_not(tab, part):
    assert tab.drop("part.npz", part)
    tab.settled()
    computed(tab, "forces", "1 mN:0.1 N:4")
    persson, cmy = (tab.page.locator(f"#theories input[value={name}]") for name in ("persson", "cmy"))
    persson.check()
    tab.wait("() => document.querySelector('#curve .legend').textContent.includes('persson')")
    assert "--theory persson" in tab.text("curve_command")
    cmy.click()
    tab.wait("() => document.getElementById('theories').textContent.includes('give Hardness')")
    assert persson.is_checked()
    assert not cmy.is_checked()


LEGEND = "() => [...document.querySelectorAll('#curve .legend li')].map((line) => line.textContent)"


def test_a_loop_under_a_hardness_shows_its_branches_and_the_flattened_surface(tab, part):
    assert tab.drop("part.npz", part)
    tab.settled()
    tab.page.get_by_role("heading", name="Plastic flow").click()
    tab.page.fill('[id="plastic.hardness"]', "1.5 GPa")
    tab.page.keyboard.press("Tab")
    tab.settled()
    assert not tab.page.locator("#flattened").is_visible()
    tab.page.check('[id="plastic.loop"]')
    computed(tab, "forces", "10 mN:0.2 N:4")
    assert tab.page.evaluate(POINTS) == 12
    assert {"loading", "unloading", "reloading"} <= {*tab.page.evaluate(LEGEND)}
    assert tab.page.input_value("#quantity") == "depth"
    tab.page.locator("#flattened").click()
    assert tab.picture[0] > 5
    assert "residual depth" in tab.text("curve_facts")
    assert "--loop" in tab.text("curve_command")
    assert len(table_of(exported(tab, "curve csv")[1].decode())) == 12
    tab.page.fill('[id="plastic.hardness"]', "2 GPa")
    tab.page.keyboard.press("Tab")
    tab.until(lambda: not tab.page.locator("#flattened").is_visible())


def test_surfaces_that_stick_show_force_against_depth_and_the_pull_off(tab, part):
    assert tab.drop("part.npz", part)
    tab.settled()
    tab.page.get_by_text("More steps").click()
    tab.page.fill('[id="preparation.crop"]', "0:24,0:24")
    tab.page.keyboard.press("Tab")
    tab.page.select_option('[id="bodies"]', "modulus")
    tab.page.fill('[id="bodies.modulus"]', "1 GPa")
    tab.page.keyboard.press("Tab")
    tab.settled()
    tab.page.select_option("#kind", "adhesion loop")
    tab.page.locator("#start").click()
    tab.wait("() => document.getElementById('curves').querySelectorAll('[aria-invalid=true]').length > 0")
    law = {"adhesion.work": "10mJ/m^2", "adhesion.range": "100nm"}
    computed(tab, kind="adhesion loop", **law, **{"turn.depth": "50nm", "turn.points": "5"})
    assert {"approach", "retreat", "pull-off force"} <= {*tab.page.evaluate(LEGEND)}
    assert "force against depth" in tab.page.get_attribute("#curve", "aria-label")
    assert "pull-off force" in tab.text("curve_facts")
    assert "roughcontact adhesion loop part.npz" in tab.text("curve_command")
    name, content = exported(tab, "curve png")
    assert re.fullmatch(r"part-adhesion-loop-[0-9a-f]{6}\.png", name)
    assert content.startswith(b"\x89PNG")
    tab.page.select_option("#kind", "adhesion detach")
    assert not tab.page.locator("#of_curve").is_visible()  # a curve of another kind is gone
    computed(tab, kind="adhesion detach", **{"adhesion.work": "10mJ/m^2"})
    assert {"retreat", "pull-off force"} <= {*tab.page.evaluate(LEGEND)}


def test_two_surfaces_stand_under_one_load(tab, part):
    assert tab.drop("one.npz", part)
    tab.settled()
    tab.page.locator("#keep").click()
    assert tab.drop("two.npz", part)
    tab.settled()
    tab.page.fill("#load", "3 MPa")
    tab.page.keyboard.press("Enter")
    row = "() => [...document.querySelectorAll('#both tr')].map((row) => row.textContent)"
    tab.until(lambda: "nominal pressure3 MPa3 MPa" in tab.page.evaluate(row))
    assert tab.text("kept_name") == "Kept: one.npz"
    assert tab.text("other_name") == "Open: two.npz"


def test_a_cut_is_moved_by_keys_and_by_number(tab, part):
    assert tab.drop("part.npz", part)
    tab.settled()
    tab.wait("() => (document.getElementById('cut').getAttribute('aria-label') || '').includes('row')")
    tab.page.locator("#map").press("ArrowRight")
    tab.wait("() => document.getElementById('cut').getAttribute('aria-label').includes('column 34')")
    tab.page.fill("#cut_place", "7")
    tab.wait("() => document.getElementById('cut').getAttribute('aria-label').includes('column 7:')")


def test_a_load_that_is_none_is_refused_beside_its_field(tab, part):
    assert tab.drop("part.npz", part)
    tab.settled()
    tab.page.fill("#load", "12 kg")
    tab.page.keyboard.press("Enter")
    tab.wait("() => document.getElementById('load').getAttribute('aria-invalid') === 'true'")
    assert "not a pressure" in tab.text("load_trouble")


def test_a_load_that_is_none_can_be_corrected_after_another_preparation(tab, part):
    assert tab.drop("part.npz", part)
    tab.settled()
    tab.page.fill("#load", "12 kg")
    tab.page.keyboard.press("Enter")
    tab.wait("() => document.getElementById('load').getAttribute('aria-invalid') === 'true'")
    tab.page.select_option('[id="preparation.level"]', "quadratic")
    tab.until(lambda: "--level quadratic" in tab.text("command"))
    tab.page.fill("#load", "12 MPa", timeout=1000 * PATIENCE)  # it waits until the field is enabled
    tab.page.keyboard.press("Enter")
    tab.settled()
    assert tab.facts["nominal pressure"] == "12 MPa"


def test_undo_ends_at_the_first_surface(tab, part):
    assert tab.drop("part.npz", part)
    tab.settled()
    load = tab.page.input_value("#load")
    tab.page.fill("#load", "3")
    tab.page.keyboard.press("Enter")
    tab.settled()
    assert tab.page.input_value("#load") == "3 MPa"  # the unit of what stood there before
    tab.page.locator("#undo").click()
    tab.settled()
    assert (tab.page.input_value("#load"), tab.text("name")) == (load, "part.npz")
    assert not tab.page.locator("#undo").is_enabled()


def test_the_load_of_the_page_follows_a_corrected_surface_and_the_one_of_the_user_stays(tab):
    tab.example("Fractal patch")
    tab.settled()
    load = tab.page.locator("#load")
    before = load.input_value()
    for rms, hand in (("2um", ""), ("4um", "7 MPa")):
        if hand:
            load.fill(hand)
            tab.page.keyboard.press("Enter")
            tab.settled()
        tab.page.fill('[id="source.rms"]', rms)
        tab.page.keyboard.press("Tab")
        tab.until(lambda rms=rms: f"--rms {rms}" in tab.text("command"))
        tab.settled()
        assert (load.input_value() == hand) == bool(hand)
    assert before != "7 MPa"


def test_a_page_that_is_loaded_again_has_its_file_and_its_load(tab, part):
    assert tab.drop("part.npz", part)
    tab.settled()
    tab.page.fill("#load", "2 MPa")
    tab.page.keyboard.press("Enter")
    tab.settled()
    facts = tab.facts
    tab.page.reload()
    tab.until(lambda: tab.text("name") == "part.npz")
    tab.settled()
    assert tab.facts == facts


def test_a_load_before_has_the_unit_of_the_load_and_the_curve_begins_without_it(tab, part):
    assert tab.drop("part.npz", part)
    tab.settled()
    after = tab.page.locator('[id="plastic.after"]')
    assert after.get_attribute("placeholder") == "1MPa"
    tab.page.select_option("#control", "force")
    tab.settled()
    assert after.get_attribute("placeholder") == "10N"
    assert "After" not in tab.text("kind_said")
    tab.page.get_by_role("heading", name="Plastic flow").click()
    after.fill("1N")
    tab.page.keyboard.press("Tab")
    tab.until(lambda: "fresh surface: After" in tab.text("kind_said"))


def test_loads_without_a_unit_are_asked_about(tab, part):
    assert tab.drop("part.npz", part)
    tab.settled()
    tab.page.select_option("#loads", "pressures")
    tab.page.fill('[id="loads.pressures"]', "1:4:3")
    tab.page.locator("#start").click()
    tab.until(
        lambda: "1:4:3 has no unit" in tab.page.locator('[id="loads.pressures_trouble"]').text_content()
    )
    computed(tab, "pressures", "1 MPa:4 MPa:3")
    assert tab.page.locator(".trouble").count() == 0


def test_a_profile_is_asked_how_it_is_pressed_and_has_no_second_direction(tab, tmp_path):
    rc.write(rc.self_affine(rc.Grid(64, 1e-6), 0.8, 1e-7, np.random.default_rng(2)), tmp_path / "line.npz")
    assert not tab.drop("line.npz", (tmp_path / "line.npz").read_bytes())
    tab.until(lambda: "line or winkler" in tab.page.locator('[id="contact.profile_trouble"]').text_content())
    for profile, unit in (("line", "Pa"), ("winkler", "N/m")):
        tab.page.select_option('[id="contact.profile"]', profile)
        tab.until(
            lambda profile=profile: (
                "roughcontact press line.npz" in tab.text("command")
                and f"--profile {profile}" in tab.text("command")
            )
        )
        tab.settled()
        tab.until(lambda unit=unit: tab.page.input_value("#load").endswith(unit))
        tab.until(lambda: not tab.page.locator("#cut_places").is_visible())
    tab.page.select_option("#loads", "forces")
    tab.page.locator("#start").click()
    tab.wait("() => document.querySelectorAll('#points tbody tr').length === 12")
    assert "--profile winkler" in tab.text("curve_command")


def test_a_single_adhesive_state_has_a_map_of_its_traction(tab, part):
    assert tab.drop("part.npz", part)
    tab.settled()
    assert not tab.page.locator("#traction").is_visible()
    tab.page.select_option("#kind", "adhesion press")
    tab.until(lambda: "The load is the one above" in tab.text("kind_said"))
    tab.page.fill('[id="adhesion.work"]', "1J/m^2")
    tab.page.fill('[id="adhesion.range"]', "100nm")
    tab.page.locator("#start").click()
    tab.page.locator("#traction").click(timeout=1000 * PATIENCE)
    tab.until(lambda: tab.text("low").startswith(("-", "≤ -")))


# What reaches beyond the screen; the heights of the bars; whether a table scrolls with its first column in view.
BEYOND = """() => [...document.querySelectorAll("body *")]
  .filter((each) => !each.closest(".table") && each.getBoundingClientRect().right > innerWidth)
  .map((each) => each.outerHTML)"""
BARS = """() => [...document.querySelectorAll(".bar.load, #view > .bar, #curves > .bar, #of_cut > .bar")]
  .map((each) => each.clientHeight)"""
SCROLLED = """() => {
  const box = document.getElementById("points").parentElement;
  box.scrollLeft = 1e6;
  const left = (each) => each.getBoundingClientRect().left;
  return box.scrollLeft > 0 && left(box.querySelector("tbody th")) >= left(box);
}"""


@pytest.fixture
def narrow(tab):
    tab.page.set_viewport_size({"width": 400, "height": 800})
    yield tab
    tab.page.set_viewport_size(SCREEN)


def test_a_narrow_screen_has_the_map_first_and_nothing_beyond_its_width(narrow, part):
    tab = narrow
    assert tab.drop("part.npz", part)
    tab.settled()
    computed(tab, "pressures", "1 MPa:4 MPa:3")
    places = [tab.page.locator(f"#{name}").bounding_box()["y"] for name in ("map", "settings", "numbers")]
    assert places == sorted(places)
    assert tab.page.evaluate(BEYOND) == []
    assert max(tab.page.evaluate(BARS)) < 50  # one line of buttons, which are 34 high
    assert tab.page.evaluate(SCROLLED)
