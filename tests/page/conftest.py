"""A browser for the tests of the page, and measured files for it; tests are skipped where there is none."""

import shutil
from pathlib import Path

import pytest

from measured import SURFACES


@pytest.fixture(scope="module")  # its event loop must be gone before others are begun
def chromium():
    """A Chromium that is driven: the one of the system, or Playwright's own."""
    api = pytest.importorskip("playwright.sync_api", reason="Playwright is not installed")
    pytest.importorskip("starlette", reason="the page needs the extra 'page'")
    with api.sync_playwright() as driver:
        named = [shutil.which(name) for name in ("chromium", "chromium-browser", "google-chrome")]
        own = Path(driver.chromium.executable_path)
        places = [place for place in [*named, str(own) if own.exists() else None] if place]
        if not places:
            pytest.skip("there is no Chromium: neither on the path nor by 'playwright install chromium'")
        # Root, as in containers, has no sandbox; their shared memory is small.
        browser = driver.chromium.launch(
            executable_path=places[0], args=["--no-sandbox", "--disable-dev-shm-usage"]
        )
        yield browser
        browser.close()


@pytest.fixture(scope="session")
def measured():
    """Paths of the measured surfaces beside the repository; none where they are not."""
    return sorted(path for path in SURFACES.iterdir() if path.name != "MANIFEST.csv") if SURFACES else []
