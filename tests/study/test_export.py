"""Records side by side: where they stand, what is kept once, what is missing, and equal files for equal studies."""

import random
import tomllib
import tracemalloc
from dataclasses import dataclass, replace

import numpy as np
import pytest
import xarray

from roughcontact.files.write import write_netcdf
from roughcontact.study.case import Positive, Pressure
from roughcontact.study.export import assemble, export
from roughcontact.study.long_table import write_long_csv
from roughcontact.study.run import run
from roughcontact.study.store import Store
from roughcontact.study.study import Study
from study.trial import NAME

STUDY = Study(
    name="trials",
    case=NAME,
    samples=3,
    parameters={"size": "2 mm"},
    table={"hurst": [0.8, 0.2], "points": {"start": 4, "stop": 6, "step": 1}},
)


@dataclass(frozen=True)
class Row:
    key: str
    record: xarray.Dataset | None
    status: str = "done"
    seconds: float = 0.5
    version: str = "1.2"


def record_of(task):
    """Return a record whose numbers tell which case it is of."""
    p = task.parameters
    force = np.arange(1.0, 5.0)
    return xarray.Dataset(
        {
            "force": ("load", force, {"units": "N", "long_name": "normal force"}),
            "stiffness": ("load", 1000 * task.sample + 100 * p.hurst + p.points + force, {"units": "N m-1"}),
            "spots": ("load", np.array([1, 2, 3, 4]) * (1 + task.sample), {"units": "1"}),
            "resolved": ("load", force > 1 + task.sample),
            "status": ("load", np.where(force > 1 + task.sample, "converged", "stagnated")),
            "modulus": ((), 1e11, {"units": "Pa"}),
            "rms": ((), 1e-6 * (1 + task.sample), {"units": "m"}),
        },
        {"axis": ["y", "x"]},
        {"title": "made up", "Conventions": "CF-1.11"},
    )


def rows_of(study, record=record_of):
    return [Row(task.key, record(task)) for task in study.tasks()]


def renumbered(changes):
    """Return a function that makes records with some variables changed where the sample is 1."""

    def record(task):
        made = record_of(task)
        return changes(made) if task.sample == 1 else made

    return record


class TestLayout:
    def test_a_case_stands_where_its_parameters_are(self):
        found = assemble(STUDY, rows_of(STUDY))
        assert found["stiffness"].dims == ("hurst", "points", "sample", "load")
        for hurst in (0.8, 0.2):
            for points in (4, 5, 6):
                for sample in range(3):
                    values = found["stiffness"].sel(hurst=hurst, points=points, sample=sample)
                    np.testing.assert_array_equal(
                        values - np.arange(1, 5), 1000 * sample + 100 * hurst + points
                    )
        assert (found["case_status"] == "done").all()
        np.testing.assert_array_equal(found["hurst"], [0.8, 0.2])
        assert found["points"].dtype.kind == "i"

    def test_the_order_of_the_rows_and_their_time_do_not_matter(self):
        rows = rows_of(STUDY)
        expected = assemble(STUDY, rows)
        random.Random(1).shuffle(rows)
        assert assemble(STUDY, [replace(row, seconds=random.random()) for row in rows]).identical(expected)

    def test_rows_make_a_dimension_of_their_own(self):
        study = Study(
            name="rows",
            case=NAME,
            samples=2,
            table={"points": [4, 5]},
            rows=[{"hurst": 0.2}, {"hurst": 0.9, "label": "rough"}, {"hurst": 0.2, "size": "1 m"}],
        )
        found = assemble(study, rows_of(study))
        assert found["stiffness"].dims == ("row", "points", "sample", "load")
        assert found["hurst"].dims == found["size"].dims == ("row",)
        np.testing.assert_array_equal(found["hurst"], [0.2, 0.9, 0.2])
        np.testing.assert_array_equal(found["size"], [1e-3, 1e-3, 1.0])
        assert found["size"].attrs["units"] == "m"
        np.testing.assert_array_equal(found["label"], ["null", "rough", "null"])
        np.testing.assert_array_equal(
            found["stiffness"].sel(row=1, points=5, sample=1, load=0), 1000 + 90 + 5 + 1
        )

    def test_what_does_not_vary_is_a_coordinate_without_a_dimension(self):
        found = assemble(STUDY, rows_of(STUDY))
        assert found["size"].dims == ()
        assert float(found["size"]) == 2e-3
        assert found["size"].attrs["units"] == "m"
        assert found["end"] == "well"
        assert "label" not in found.variables  # None is nothing to write down

    def test_a_study_without_a_table_has_its_samples(self):
        study = Study(name="one", case=NAME, samples=4, parameters={"hurst": 0.5})
        found = assemble(study, rows_of(study))
        assert found["stiffness"].dims == ("sample", "load")
        assert float(found["hurst"]) == 0.5

    def test_a_table_of_one_value_is_a_dimension(self):
        study = Study(name="one", case=NAME, samples=2, table={"hurst": [0.5]})
        assert assemble(study, rows_of(study))["stiffness"].dims == ("hurst", "sample", "load")

    def test_cases_of_another_study_are_left_out(self):
        more = STUDY.with_samples(5)
        assert assemble(STUDY, rows_of(more)).identical(assemble(STUDY, rows_of(STUDY)))


class TestOnce:
    def test_what_all_records_agree_on_is_kept_once(self):
        found = assemble(STUDY, rows_of(STUDY))
        assert found["force"].dims == ("load",)
        assert found["modulus"].dims == ()
        assert found["force"].attrs == {"units": "N", "long_name": "normal force"}
        assert found["rms"].dims == ("hurst", "points", "sample")

    def test_also_where_it_is_nan(self):
        made = rows_of(STUDY, lambda task: record_of(task).assign(hole=("load", [1.0, np.nan, 3.0, 4.0])))
        np.testing.assert_array_equal(assemble(STUDY, made)["hole"], [1, np.nan, 3, 4])

    def test_but_not_what_a_record_lacks(self):
        made = rows_of(STUDY, renumbered(lambda record: record.drop_vars("modulus")))
        found = assemble(STUDY, made)["modulus"]
        assert found.dims == ("hurst", "points", "sample")
        assert np.isnan(found.sel(sample=1)).all()
        assert (found.sel(sample=[0, 2]) == 1e11).all()

    def test_one_record_agrees_with_itself_and_says_nothing(self):
        found = assemble(STUDY, rows_of(STUDY)[:1])
        assert found["force"].dims == ("hurst", "points", "sample", "load")
        assert int(found["force"].notnull().sum()) == 4
        assert found["axis"].dims == ("axis",)


class TestMissing:
    def test_failed_and_missing_cases_are_told_apart(self):
        rows = rows_of(STUDY)[:-2]
        rows[3] = replace(rows[3], record=None, status="failed")
        found = assemble(STUDY, rows)
        states, counts = np.unique(found["case_status"], return_counts=True)
        assert dict(zip(states, counts, strict=True)) == {"done": 15, "failed": 1, "missing": 2}
        lacking = found["case_status"] != "done"
        assert (found["stiffness"].isnull().any("load") == lacking).all()

    def test_kinds_stay_where_nothing_is_missing(self):
        found = assemble(STUDY, rows_of(STUDY))
        assert [found[name].dtype.kind for name in ("spots", "resolved", "status")] == ["i", "b", "U"]

    def test_whole_numbers_become_real_truths_false_and_words_empty(self):
        found = assemble(STUDY, rows_of(STUDY)[:-1])
        last = {"hurst": 0.2, "points": 6, "sample": 2}
        assert found["spots"].dtype.kind == "f"
        assert np.isnan(found["spots"].sel(last)).all()
        np.testing.assert_array_equal(found["spots"].sel(hurst=0.2, points=6, sample=1), [2, 4, 6, 8])
        assert found["resolved"].dtype == bool
        assert not found["resolved"].sel(last).any()
        assert (found["status"].sel(last) == "").all()

    def test_shorter_records_are_filled_up(self):
        made = rows_of(STUDY, renumbered(lambda record: record.isel(load=slice(2))))
        found = assemble(STUDY, made)
        assert found.sizes["load"] == 4
        # The force is no coordinate: it differs.
        assert found["force"].dims == ("hurst", "points", "sample", "load")
        np.testing.assert_array_equal(
            found["force"].sel(hurst=0.2, points=4, sample=1), [1, 2, np.nan, np.nan]
        )
        assert found["spots"].dtype.kind == "f"
        assert not np.isnan(found["stiffness"].sel(sample=[0, 2])).any()

    def test_nothing_at_all(self):
        found = assemble(STUDY, [])
        assert (found["case_status"] == "missing").all()
        assert set(found.data_vars) == {"case_status"}
        np.testing.assert_array_equal(found["hurst"], [0.8, 0.2])

    def test_words_of_any_length(self):
        made = rows_of(
            STUDY, renumbered(lambda record: record.assign(status=("load", ["a longer word"] * 4)))
        )
        assert (assemble(STUDY, made)["status"].sel(sample=1) == "a longer word").all()


class TestPoints:
    def test_coordinates_that_go_on_are_kept_once(self):
        def record(task):
            made = record_of(task).assign_coords(load=[10, 20, 30, 40])
            return made.isel(load=slice(task.parameters.points - 2))

        found = assemble(STUDY, rows_of(STUDY, record))
        np.testing.assert_array_equal(found["load"], [10, 20, 30, 40])
        assert found["load"].dims == ("load",)

    def test_coordinates_that_differ_are_variables(self):
        def record(task):
            return record_of(task).assign_coords(load=np.arange(4) + task.sample)

        found = assemble(STUDY, rows_of(STUDY, record))
        assert "load" not in found.coords
        assert found["record_load"].dims == ("hurst", "points", "sample", "load")
        np.testing.assert_array_equal(found["record_load"].sel(hurst=0.8, points=4, sample=2), [2, 3, 4, 5])


class TestNames:
    def test_a_parameter_that_varies_keeps_its_name(self):
        def record(task):
            return record_of(task).assign(hurst=((), task.parameters.hurst + 0.01, {"units": "1"}))

        found = assemble(STUDY, rows_of(STUDY, record))
        np.testing.assert_array_equal(found["hurst"], [0.8, 0.2])
        np.testing.assert_allclose(found["record_hurst"].sel(hurst=0.2), 0.21, rtol=1e-15)

    def test_dimensions_of_records_too(self):
        def record(task):
            return record_of(task).rename(load="points")

        found = assemble(STUDY, rows_of(STUDY, record))
        assert found["stiffness"].dims == ("hurst", "points", "sample", "record_points")

    def test_of_a_parameter_that_does_not_vary_the_record_knows_more(self):
        def record(task):
            return record_of(task).assign(size=((), 0.1 + task.sample, {"units": "m"}))

        found = assemble(STUDY, rows_of(STUDY, record))
        assert found["size"].dims == ("hurst", "points", "sample")


class TestAttributes:
    def test_tell_the_study_and_what_records_agree_on(self):
        def record(task):
            made = record_of(task).assign_attrs(note=f"sample {task.sample}")
            made["stiffness"].attrs["note"] = task.sample
            return made

        rows = rows_of(STUDY, record)
        rows[0] = replace(rows[0], version="1.1")
        found = assemble(STUDY, rows)
        assert Study(**tomllib.loads(found.attrs["study"])) == STUDY
        assert found.attrs["source"] == "roughcontact 1.1, 1.2"
        assert found.attrs["title"] == "made up"
        assert "note" not in found.attrs
        assert found["stiffness"].attrs == {"units": "N m-1"}

    def test_another_unit_is_refused(self):
        def changed(record):
            record["stiffness"].attrs["units"] = "N m-2"
            return record

        with pytest.raises(ValueError, match="'stiffness' is in N m-1 in one record and in N m-2 in another"):
            assemble(STUDY, rows_of(STUDY, renumbered(changed)))

    def test_other_dimensions_are_refused(self):
        changed = renumbered(lambda record: record.assign(stiffness=("axis", [1.0, 2.0])))
        with pytest.raises(ValueError, match=r"'stiffness' has the dimensions \('axis',\) in one record"):
            assemble(STUDY, rows_of(STUDY, changed))

    def test_seconds_are_there_if_asked_for(self):
        found = assemble(STUDY, rows_of(STUDY)[:-1], seconds=True)["case_seconds"]
        assert found.attrs["units"] == "s"
        assert np.isnan(found.sel(hurst=0.2, points=6, sample=2))
        assert float(found.sum()) == 17 * 0.5


def test_a_quantity_that_may_be_none_has_a_unit(monkeypatch):
    from study import trial

    class Hardened(trial.Trial):
        hardness: Positive[Pressure] | None = None

    monkeypatch.setattr(trial, "CASE", replace(trial.CASE, parameters=Hardened))
    study = Study(name="hard", case=NAME, parameters={"hurst": 0.5}, rows=[{}, {"hardness": "2 GPa"}])
    found = assemble(study, rows_of(study))["hardness"]
    np.testing.assert_array_equal(found, [np.nan, 2e9])
    assert found.attrs["units"] == "Pa"


def test_a_parameter_must_not_be_called_sample(monkeypatch):
    from study import trial

    class Sampled(trial.Trial):
        sample: int = 0

    monkeypatch.setattr(trial, "CASE", replace(trial.CASE, parameters=Sampled))
    study = Study(name="bad", case=NAME, parameters={"hurst": 0.5}, table={"sample": [1, 2]})
    with pytest.raises(ValueError, match="cannot be called 'sample'"):
        assemble(study, [])


def test_it_holds_little_more_than_what_it_returns():
    study = Study(
        name="many", case=NAME, samples=20, table={"hurst": {"start": 0.1, "stop": 1.0, "step": 0.1}}
    )

    def rows():
        for task in study.tasks():
            force = np.random.default_rng(task.sample).random(500)
            yield Row(task.key, xarray.Dataset({f"v{i}": ("load", force + i) for i in range(5)}))

    first = next(rows())
    assert first.record.nbytes == 5 * 500 * 8
    tracemalloc.start()
    found = assemble(study, rows())
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert found.nbytes > 4e6
    # What was gathered, and one variable of it laid out; a quarter for small things.
    assert peak < (1 + 1 / 5 + 1 / 4) * found.nbytes


class TestStore:
    def study(self, samples=2):
        table = {"hurst": [0.3, 0.7], "points": [4, 6], "end": ["well", "error"]}
        return Study(name="real", case=NAME, samples=samples, table=table)

    def test_of_a_study_that_grows(self, tmp_path):
        run(self.study(), tmp_path)
        with Store.open(tmp_path) as store:
            first = export(store)
            assert export(store).identical(first)
        assert dict(first.sizes) == {"hurst": 2, "points": 2, "end": 2, "sample": 2, "load": 6, "axis": 2}
        assert (first["case_status"].sel(end="error") == "failed").all()
        np.testing.assert_array_equal(first["load"], np.arange(6))
        good = first["stiffness"].sel(end="well")
        assert (good.notnull().sum("load") == first["points"]).all()
        # Samples are paired: the same random numbers whatever the exponent.
        np.testing.assert_array_equal(first["force"].sel(hurst=0.3), first["force"].sel(hurst=0.7))
        run(self.study(3), tmp_path)
        with Store.open(tmp_path) as store:
            second = export(store)
        xarray.testing.assert_identical(
            second.isel(sample=slice(2)).drop_attrs(deep=False), first.drop_attrs(deep=False)
        )

    def test_files_of_two_runs_are_equal(self, tmp_path):
        for name in ("a", "b"):
            run(self.study(), tmp_path / name)
            with Store.open(tmp_path / name) as store:
                found = export(store)
            write_netcdf(found, tmp_path / f"{name}.nc")
            write_long_csv(found, tmp_path / f"{name}.csv")
        assert (tmp_path / "a.csv").read_bytes() == (tmp_path / "b.csv").read_bytes()
        one, other = (xarray.load_dataset(tmp_path / f"{n}.nc", engine="h5netcdf") for n in "ab")
        assert one.identical(other)
        assert one.identical(found)
