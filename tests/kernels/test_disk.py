"""Machine code on disk: mended, done without, and never run where it may be another's."""

import os

import platformdirs
import pytest

from roughcontact.kernels import disk, loader

posix = pytest.mark.skipif(os.name != "posix", reason="owners and modes are those of POSIX")
pytestmark = pytest.mark.skipif(not loader.is_available(), reason="no machine code here")


@pytest.fixture
def others(monkeypatch):
    """Return what gives a file or folder to another user; where only root may, this user becomes another."""
    other = os.geteuid() + 54321
    if os.geteuid() == 0:
        return lambda place: os.chown(place, other, -1)
    return lambda place: monkeypatch.setattr(os, "geteuid", lambda: other)


@pytest.mark.parametrize(
    "damage",
    [
        lambda whole: b"",
        lambda whole: whole[:10],
        lambda whole: whole[: disk.DIGEST],
        lambda whole: whole[:-1],
        lambda whole: whole[: len(whole) // 2],
        lambda whole: whole + b"\0",
        lambda whole: bytes([whole[0] ^ 1]) + whole[1:],
        lambda whole: whole[:-200] + bytes([whole[-200] ^ 64]) + whole[-199:],
        lambda whole: bytes(len(whole)),
    ],
)
def test_damaged_code_is_translated_anew_and_replaced(kept, translated, damage, works):
    assert works()
    (file,) = kept.iterdir()
    whole = file.read_bytes()
    file.write_bytes(damage(whole))
    assert works()
    assert len(translated) == 2
    assert [f.name for f in kept.iterdir()] == [file.name]
    assert works()
    assert len(translated) == 2


def test_nothing_half_written_stays(kept, translated, works):
    """A file in the code's place that cannot be replaced: the rest of it is taken away."""
    assert works()
    (place,) = kept.iterdir()
    place.unlink()
    place.mkdir()
    (place / "something").write_text("in the way")
    assert works()
    assert [f.name for f in kept.iterdir()] == [place.name]
    assert works()
    assert len(translated) == 3


def test_a_disk_that_is_full_does_not_matter(kept, translated, monkeypatch, works):
    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "replace", full)
    assert works()
    assert list(kept.iterdir()) == []


def test_a_folder_that_cannot_be_made_does_not_matter(kept, translated, monkeypatch, tmp_path, works):
    (tmp_path / "file").write_text("not a folder")
    monkeypatch.setattr(platformdirs, "user_cache_path", lambda name: tmp_path / "file" / name)
    assert works()
    assert works()
    assert len(translated) == 2
    assert (tmp_path / "file").read_text() == "not a folder"


def test_code_of_another_key_is_not_run(kept, translated, works):
    """It subtracts, or takes numbers of another precision; its name says otherwise."""
    for family, precision in (("other", "float64"), ("tiny", "float32")):
        assert works()
        (ours,) = kept.glob("tiny-float64-*")
        loader.functions(family, precision)
        (theirs,) = kept.glob(f"{family}-{precision}-*")
        os.replace(theirs, ours)
        assert works()
    assert [done for done in translated if done == ("tiny", "float64")] == [("tiny", "float64")] * 3


def test_code_without_the_function_is_made_anew(kept, translated, works):
    """An address of 0, which would end the process."""
    assert works()
    (file,) = kept.iterdir()
    wrong = loader._translated(loader._kernels("tiny"), "float32")
    disk.keep(file.name, loader._key("tiny", "float64"), wrong)
    assert works()
    assert works()
    assert [precision for _, precision in translated] == ["float64", "float32", "float64"]


@posix
@pytest.mark.parametrize("mode", [0o660, 0o606, 0o666])
def test_a_file_that_others_can_write_to_is_not_run_but_replaced(kept, translated, mode, works):
    assert works()
    (file,) = kept.iterdir()
    file.chmod(mode)
    assert works()
    assert works()
    assert len(translated) == 2
    assert file.stat().st_mode & 0o77 == 0


@posix
def test_a_file_of_another_user_is_not_run(kept, translated, others, works):
    assert works()
    others(next(kept.iterdir()))
    assert works()
    assert len(translated) == 2


@posix
@pytest.mark.parametrize("mode", [0o770, 0o707, 0o1777])
@pytest.mark.parametrize("above", [False, True])
def test_a_folder_that_others_can_write_to_is_neither_read_nor_written(kept, translated, mode, above, works):
    assert works()
    (kept.parent if above else kept).chmod(mode)
    assert works()
    if above and mode & 0o1000:  # as /tmp is: everybody writes, but what is in it belongs to its owners
        assert len(translated) == 1
    else:
        assert works("float32")
        assert len(translated) == 3
        assert len(list(kept.iterdir())) == 1


@posix
@pytest.mark.parametrize("above", [False, True])
def test_a_folder_of_another_user_is_neither_read_nor_written(kept, translated, others, above, works):
    assert works()
    others(kept.parent if above else kept)
    assert works()
    assert works("float32")
    assert len(translated) == 3
    assert len(list(kept.iterdir())) == 1


@posix
def test_a_link_in_place_of_a_file_is_not_followed_but_replaced(kept, translated, tmp_path, works):
    assert works()
    (file,) = kept.iterdir()
    file.rename(tmp_path / "elsewhere")
    file.symlink_to(tmp_path / "elsewhere")
    assert works()
    assert works()
    assert len(translated) == 2
    assert not file.is_symlink()


@posix
def test_a_pipe_in_place_of_a_file_keeps_nobody_waiting(kept, translated, works):
    assert works()
    (file,) = kept.iterdir()
    file.unlink()
    os.mkfifo(file)
    assert works()
    assert works()
    assert len(translated) == 2


@posix
@pytest.mark.parametrize("open_to_others", [False, True])
def test_a_link_to_a_folder_is_as_good_as_the_folder(kept, translated, tmp_path, open_to_others, works):
    """A folder for caches on another disk, say."""
    (tmp_path / "disk").mkdir(mode=0o700)
    kept.parent.symlink_to(tmp_path / "disk")
    if open_to_others:
        (tmp_path / "disk").chmod(0o777)
    assert works()
    assert works()
    assert len(translated) == 1 + open_to_others


@posix
def test_folders_are_made_for_the_user_alone(kept, translated, works):
    before = os.umask(0o002)
    try:
        assert works()
    finally:
        os.umask(before)
    assert [place.stat().st_mode & 0o777 for place in (kept, kept.parent)] == [0o700, 0o700]
    assert works()
    assert len(translated) == 1
