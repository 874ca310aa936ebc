"""Writers of small files to read."""

import hashlib
import io
import zipfile

import numpy as np
import pytest

X3P_TYPES = {"I": "<i2", "L": "<i4", "F": "<f4", "D": "<f8"}


def x3p_bytes(
    raw,
    kind="D",
    *,
    listed=False,
    valid=None,
    increment=None,
    offset=None,
    folder="",
    spacing=(2e-6, 3e-6),
    checksum_of="main",
    points_md5=None,
    feature="SUR",
    extra="",
    size_z=1,
):
    """Return an X3P file of the raw numbers (ny, nx), written by its own few lines."""
    ny, nx = raw.shape
    points = np.ascontiguousarray(raw).astype(X3P_TYPES[kind]).tobytes()
    members = {}
    if listed:
        entries = "".join(
            "<Datum/>" if np.isnan(v) else f"<Datum>{v!r}</Datum>" for v in raw.ravel().tolist()
        )
        data = f"<DataList>{entries}</DataList>"
    else:
        members["bindata/data.bin"] = points
        digest = points_md5 or hashlib.md5(points).hexdigest().upper()
        link = "<PointDataLink>bindata/data.bin</PointDataLink>"
        link += f"<MD5ChecksumPointData>{digest}</MD5ChecksumPointData>"
        if valid is not None:
            bits = np.packbits(valid.ravel(), bitorder="little").tobytes()
            members["bindata/valid.bin"] = bits
            link += "<ValidPointsLink>bindata/valid.bin</ValidPointsLink>"
            link += f"<MD5ChecksumValidPoints>{hashlib.md5(bits).hexdigest()}</MD5ChecksumValidPoints>"
        data = f"<DataLink>{link}</DataLink>"
    z = "".join(
        f"<{name}>{value!r}</{name}>"
        for name, value in (("Increment", increment), ("Offset", offset))
        if value is not None
    )
    main = f"""<?xml version="1.0" encoding="UTF-8"?>{extra}
<p:ISO5436_2 xmlns:p="http://www.opengps.eu/2008/ISO5436_2">
<Record1><Revision>ISO5436 - 2000</Revision><FeatureType>{feature}</FeatureType><Axes>
<CX><AxisType>I</AxisType><DataType>D</DataType><Increment>{spacing[1]!r}</Increment><Offset>0</Offset></CX>
<CY><AxisType>I</AxisType><DataType>D</DataType><Increment>{spacing[0]!r}</Increment><Offset>0</Offset></CY>
<CZ><AxisType>A</AxisType><DataType>{kind}</DataType>{z}</CZ></Axes></Record1>
<Record3><MatrixDimension><SizeX>{nx}</SizeX><SizeY>{ny}</SizeY><SizeZ>{size_z}</SizeZ></MatrixDimension>{data}</Record3>
<Record4><ChecksumFile>md5checksum.hex</ChecksumFile></Record4></p:ISO5436_2>""".encode()
    members["main.xml"] = main
    checked = {"main": main, "points": points, "nothing": b"another file"}
    if checksum_of:
        members["md5checksum.hex"] = (hashlib.md5(checked[checksum_of]).hexdigest() + " *main.xml").encode()
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in members.items():
            archive.writestr(folder + name, content)
    return stream.getvalue()


@pytest.fixture(scope="session")
def make_x3p():
    return x3p_bytes


@pytest.fixture
def put(tmp_path):
    """Write bytes or a text under a name and return the path."""

    def write(name, content):
        path = tmp_path / name
        path.write_bytes(content.encode() if isinstance(content, str) else content)
        return path

    return write


@pytest.fixture(scope="session")
def npy():
    """Return the bytes of a ``.npy`` file."""

    def write(array):
        stream = io.BytesIO()
        np.save(stream, array)
        return stream.getvalue()

    return write


@pytest.fixture(scope="session")
def npz():
    """Return the bytes of a ``.npz`` file."""

    def write(**arrays):
        stream = io.BytesIO()
        np.savez_compressed(stream, **arrays)
        return stream.getvalue()

    return write
