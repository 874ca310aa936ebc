"""The left side of the page in a real browser: what a file leaves open, its preparation, the bodies, steps back."""

import time

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.recipe.bodies import Bodies
from roughcontact.recipe.contact import Contact
from roughcontact.recipe.plastic_flow import AfterLoad
from roughcontact.recipe.preparation import Preparation
from roughcontact.recipe.recipe_fields import specs
from roughcontact.recipe.source import File
from served import PATIENCE, ended, opened_again, started

WAITING = """() => ["view", "surface"].some((id) => document.getElementById(id).getAttribute("aria-busy") === "true")
  || document.querySelector("main").inert || document.getElementById("slider").disabled"""
# Names that a screen reader would say, and ids that stand twice.
NAMELESS = """() => {
  const name = (each) => each.getAttribute("aria-label") || each.innerText
    || [...(each.labels || [])].map((label) => label.innerText).join("");
  const all = document.querySelectorAll("input, select, button, summary, section, [tabindex]");
  return [...all].filter((each) => !name(each).trim()).map((each) => each.outerHTML);
}"""
TWICE = """() => {
  const ids = [...document.querySelectorAll("[id]")].map((each) => each.id);
  return ids.filter((id, k) => ids.indexOf(id) !== k);
}"""
# Texts and placeholders whose contrast with their ground is below 4.5, as WCAG computes it.
FAINT = """() => {
  const numbers = (text) => text.match(/[\\d.]+/g).map(Number);
  const light = (colour) => {
    const [r, g, b] = colour.map((c) => (c /= 255) <= 0.03928 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4);
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  };
  const ground = (each) => {
    for (; each; each = each.parentElement) {
      const [r, g, b, a = 1] = numbers(getComputedStyle(each).backgroundColor);
      if (a > 0.99) return [r, g, b];
    }
    return [255, 255, 255];
  };
  const contrast = (each, pseudo) => {
    const ink = numbers(getComputedStyle(each, pseudo).color).slice(0, 3);
    const [low, high] = [light(ink), light(ground(each))].sort((a, b) => a - b);
    return (high + 0.05) / (low + 0.05);
  };
  const written = (each) => each.offsetParent && !each.closest(".unseen, svg")
    && (each.matches("input, select") || [...each.childNodes].some((node) => node.nodeType === 3 && node.data.trim()));
  return [...document.querySelectorAll("body *")].filter(written).filter((each) =>
    contrast(each) < 4.5 || (each.placeholder && contrast(each, "::placeholder") < 4.5)).map((each) => each.outerHTML);
}"""


class Person:
    """Somebody at the page."""

    def __init__(self, page):
        self.page = page

    def wait(self):
        asked = f"""async (patience) => {{
          const waiting = {WAITING};
          for (const before = Date.now() + patience; waiting(); ) {{
            if (Date.now() > before) return false;
            await new Promise((next) => setTimeout(next, 20));
          }}
          return true;
        }}"""
        assert self.page.evaluate(asked, 1000 * PATIENCE), self.page.locator("#said").inner_text()

    def field(self, name):
        return self.page.locator(f'[id="{name}"]')

    def write(self, name, text):
        self.unfold(name)
        self.field(name).fill(text)
        self.page.keyboard.press("Tab")

    def choose(self, name, value):
        self.unfold(name)
        self.field(name).select_option(value)

    def unfold(self, name):
        """Open what a field is folded in."""
        self.field(name).wait_for(state="attached")  # forms are made when the server has answered
        self.page.evaluate(
            """(id) => {
              let folded = document.getElementById(id).closest("details");
              for (; folded; folded = folded.parentElement.closest("details")) folded.open = true;
            }""",
            name,
        )

    def open(self, file):
        """Upload a file; its name is shown when the page has made its forms anew, without what was in them."""
        content = {
            "name": file.name,
            "mimeType": "application/octet-stream",
            "buffer": file.read_bytes(),
        }
        self.page.set_input_files("#file", content)
        self.page.locator("#name", has_text=file.name).wait_for(timeout=1000 * PATIENCE)

    def text(self, name):
        return self.field(name).text_content()

    def trouble(self, name, words):
        """Wait until this is said beside a field."""
        line = self.page.locator(f'[id="{name}_trouble"]', has_text=words)
        line.wait_for(timeout=1000 * PATIENCE)
        assert self.field(name).get_attribute("aria-errormessage") == f"{name}_trouble"

    @property
    def command(self):
        """The command that is stated when all is computed."""
        self.wait()
        return self.text("command")


@pytest.fixture(scope="module")
def server(tmp_path_factory):
    served = started(tmp_path_factory.mktemp("settings"))
    yield served
    ended(served)


@pytest.fixture(scope="module")
def opened(chromium):
    """A page, and what its scripts tell of errors."""
    context = chromium.new_context(viewport={"width": 1400, "height": 1000})
    page, told = context.new_page(), []
    page.on("pageerror", lambda error: told.append(str(error)))
    page.on("console", lambda line: told.append(line.text) if line.type == "error" else None)
    yield page, told
    context.close()


@pytest.fixture
def person(opened, server):
    page, told = opened
    opened_again(page, server.address)
    told.clear()
    yield Person(page)
    assert told == []


@pytest.fixture(scope="module")
def heights():
    found = rc.self_affine(rc.Grid((64, 64), 1e-6), 0.8, 1e-7, np.random.default_rng(2)).heights.copy()
    found[10, 20] = 9e-6
    return found


@pytest.fixture
def bare(heights, tmp_path):
    """A file that states neither unit nor size."""
    np.save(tmp_path / "bare.npy", 1e9 * heights)
    return tmp_path / "bare.npy"


@pytest.fixture
def part(heights, tmp_path):
    rc.write(rc.Surface(heights, rc.Grid((64, 64), 1e-6)), tmp_path / "part.npz")
    return tmp_path / "part.npz"


def test_what_a_file_leaves_open_is_asked_for(person, bare):
    person.open(bare)
    for field in ("source.unit", "source.size"):
        person.trouble(field, "Fill in Unit (of the heights) and Size (the width of the map).")
    person.write("source.unit", "nm")
    person.write("source.size", "64 apples")
    person.trouble("source.size", "apples")
    person.write("source.size", "64 um")
    assert "--unit nm --size '64 um'" in person.command
    assert person.page.locator(".trouble").count() == 0


def test_a_warning_is_mended_by_its_button_and_undone(person, part):
    person.open(part)
    before = person.command
    person.page.get_by_role("button", name="Fill the spikes").click()
    assert "--despike filled" in person.command
    assert "corrected by the preparation" in person.text("warnings")
    person.page.keyboard.press("Control+z")
    assert person.command == before
    person.page.keyboard.press("Control+y")
    assert "--despike filled" in person.command


def test_a_crop_is_dragged_typed_and_taken_back(person, part):
    person.open(part)
    person.wait()
    person.page.locator("#crop").click()
    box = person.page.locator("#map").bounding_box()
    for move, (x, y) in (("down", (0.25, 0.25)), ("up", (0.75, 0.625))):
        person.page.mouse.move(box["x"] + x * box["width"], box["y"] + y * box["height"])
        getattr(person.page.mouse, move)()
    assert "--crop 16:41,16:49" in person.command  # the cells under both ends belong to it
    person.write("preparation.crop", "16:40,16:49")
    assert "--crop 16:40,16:49" in person.command
    person.write("preparation.crop", "40:40,16:49")
    person.trouble("preparation.crop", "40:40 holds no cell")
    person.write("preparation.crop", "")
    assert "--crop" not in person.command


def test_a_crop_is_dragged_over_a_part_of_the_map_that_is_averaged(person, part):
    person.open(part)
    person.write("preparation.crop", "16:48,:32")
    person.write("preparation.average", "4")
    person.wait()
    person.page.locator("#crop").click()
    box = person.page.locator("#map").bounding_box()
    for move, (x, y) in (("down", (0.05, 0.05)), ("up", (0.55, 0.8))):
        person.page.mouse.move(box["x"] + x * box["width"], box["y"] + y * box["height"])
        getattr(person.page.mouse, move)()
    assert "--crop 16:44,0:20" in person.command  # seven cells of four down, five along


def test_bodies_are_given_in_every_way(person, part):
    person.open(part)
    assert "--materials steel,aluminium" in person.command
    person.write("plastic.hardness", "aluminium")
    assert "--hardness aluminium" in person.command
    person.choose("bodies.materials.2", "gold")
    person.wait()
    assert "--materials steel,gold" in person.command
    person.choose("bodies", "young")
    assert "--young '205 GPa' --poisson 0.29 --young2 '78 GPa' --poisson2 0.44" in person.command
    person.write("bodies.poisson", "0.7")
    person.trouble("bodies.poisson", "Poisson's ratio must lie")
    person.write("bodies.poisson", "0.3")
    person.wait()
    person.choose("bodies", "modulus")
    assert "--modulus" in person.command  # the one of the bodies before
    person.write("bodies.modulus", "100")
    person.trouble("bodies.modulus", "without a unit")
    person.write("bodies.modulus", "100 GPa")
    assert "--modulus '100 GPa'" in person.command


def test_steps_of_the_preparation_are_stated(person, part):
    person.open(part)
    person.write("preparation.mask", "box=0:9,0:9\noutside-ellipse=0:64,0:64")
    person.choose("preparation.window", "tukey")
    person.write("preparation.share", "0.5")
    person.write("preparation.tip", "2um")
    command = person.command
    for option in (
        "--mask box=0:9,0:9",
        "--mask outside-ellipse=0:64,0:64",
        "--tip 2um",
        "--window tukey --share 0.5",
    ):
        assert option in command
    person.choose("preparation.window", "")
    assert "--share" not in person.command  # a field goes with the one that it needs
    assert person.field("preparation.share").is_hidden()


def test_every_field_of_a_job_is_in_a_form(person, part):
    """Of the steps of the preparation all; of other parts too, except those of files of the command."""
    person.open(part)
    person.wait()
    for part_of_job in (Preparation, Bodies, AfterLoad, Contact, File):
        form = part_of_job.__name__.replace("AfterLoad", "Plastic").replace("File", "Source").lower()
        names = [each.name for each, spec in specs(part_of_job) if spec.option and each.name != "file"]
        assert len(names) > 2 or part_of_job is Contact
        for name in names:
            assert person.field(f"{form}.{name}").count() == 1, (form, name)


def test_the_help_of_a_field_is_shown_where_it_has_the_focus(person, part):
    person.open(part)
    person.wait()
    person.unfold("preparation.tip")
    person.field("preparation.tip").focus()
    assert "Simulate the scan of a tip of this radius" in person.text("help")


def test_surfaces_that_come_without_a_file_are_prepared_alike(person):
    ball = person.page.locator("#example option", has_text="Ball")
    ball.wait_for(state="attached", timeout=1000 * PATIENCE)
    person.choose("example", ball.get_attribute("value"))
    person.wait()
    person.write("source.points", "48")
    assert person.command == "roughcontact run press-job.toml"
    person.choose("source.shape", "cone")
    person.trouble("source.radius", "a cone takes slope")


def test_a_flat_shows_no_roughness_of_the_surface_before_it(person, part, tmp_path):
    person.open(part)
    person.wait()
    assert "Sq" in person.text("roughness")
    rc.write(rc.Surface(np.zeros((16, 16)), rc.Grid((16, 16), 1e-6)), tmp_path / "flat.npz")
    person.open(tmp_path / "flat.npz")
    said = person.page.locator("#said", has_text="The surface is flat")
    said.wait_for(timeout=1000 * PATIENCE)
    person.page.locator("#surface[aria-busy=false]").wait_for(timeout=1000 * PATIENCE)
    assert person.text("roughness") == ""
    assert "16 x 16" in person.text("surface_facts")


def test_what_is_being_typed_outlives_an_answer(person, part):
    person.open(part)
    person.wait()
    person.unfold("preparation.short_cutoff")
    person.field("preparation.short_cutoff").click()
    person.page.keyboard.type("8")
    person.page.evaluate(
        """() => {
          const field = document.getElementById("preparation.despike");
          field.value = "filled";
          field.onchange();
        }"""
    )
    person.wait()
    person.page.keyboard.type(" um")
    person.page.keyboard.press("Tab")
    assert "--despike filled --level plane --short-cutoff '8 um'" in person.command


def test_every_field_has_a_name_and_every_text_is_readable(person, part):
    person.open(part)
    person.wait()
    person.write("preparation.short_cutoff", "8")
    person.trouble("preparation.short_cutoff", "leaves nothing")
    person.page.evaluate("for (const each of document.querySelectorAll('details')) each.open = true")
    assert person.page.evaluate(NAMELESS) == []
    assert person.page.evaluate(TWICE) == []
    for theme in ("light", "dark"):
        while person.page.evaluate("document.documentElement.dataset.theme") != theme:
            person.page.locator("#theme").click()
        for width in (400, 1400, 3840):
            person.page.set_viewport_size({"width": width, "height": 1000})
            before = time.monotonic() + PATIENCE
            while (
                person.page.evaluate("document.documentElement.scrollWidth") != width
            ):  # something sticks out
                assert time.monotonic() < before, (theme, width)
                person.page.wait_for_timeout(20)
            assert person.page.evaluate(FAINT) == [], (theme, width)
