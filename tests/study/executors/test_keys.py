"""Keys that a script of a job gives to a scheduler and its workers."""

import sys

import pytest

from roughcontact.study.executors.keys import write_keys

pytest.importorskip("cryptography")
distributed = pytest.importorskip("distributed")
config = pytest.importorskip("dask.config")


@pytest.mark.skipif(sys.platform == "win32", reason="rights of files are others there")
def test_keys_are_for_their_user_alone(tmp_path):
    write_keys(str(tmp_path))
    assert {each.name: each.stat().st_mode & 0o777 for each in tmp_path.iterdir()} == {
        "cert.pem": 0o600,
        "key.pem": 0o600,
    }
    with pytest.raises(FileExistsError):
        write_keys(str(tmp_path))


def test_a_scheduler_takes_the_keys_and_asks_everybody_for_them(tmp_path):
    write_keys(str(tmp_path))
    certificate, key = str(tmp_path / "cert.pem"), str(tmp_path / "key.pem")
    settings = {"distributed.comm.require-encryption": True, "distributed.comm.tls.ca-file": certificate}
    for role in "client", "scheduler", "worker":
        settings |= {
            f"distributed.comm.tls.{role}.cert": certificate,
            f"distributed.comm.tls.{role}.key": key,
        }
    with config.set(settings):
        security = distributed.Security()
    for role in "client", "scheduler", "worker":
        assert security.get_connection_args(role)["require_encryption"]
        assert security.get_tls_config_for_role(role)["key"] == key
