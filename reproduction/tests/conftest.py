from cli.conftest import invoke  # noqa: F401
