"""A small file of every format that a few lines can write, by name.

The layouts are those of the formats' descriptions; no byte is copied from a measured file.
"""

from files import instrument_formats, plain_formats
from files.writing import FILES, Written

__all__ = ["FILES", "TWINS", "Written", "instrument_formats", "plain_formats"]

# The measured files, which lie beside some checkouts, and the written file of the same format for each.
TWINS = {
    "AR_20211011.ibw": "asylum.ibw",
    "ISO5436-sample1.x3p": "listed.x3p",
    "KautschukInfiniteFocus.x3p": "binary.x3p",
    "Park_20210916_034.tiff": "park.tiff",
    "al3d-1.al3d": "alicona.al3d",
    "dektak-1.csv": "profile.csv",
    "derived_al3d_crop.xyz": "points.xyz",
    "derived_di3_nm.npy": "bare.npy",
    "derived_frt2_masked.gwy": "gwyddion.gwy",
    "derived_mi1.mat": "bare.mat",
    "derived_top1.nc": "classic.nc",
    "di-3.di": "nanoscope.001",
    "frt-2.frt": "microprof.frt",
    "gwyddion-export-german.txt": "gwyddion-german.txt",
    "image.nid": "nanosurf.nid",
    "matrix-3.txt": "gwyddion.txt",
    "mi-1.mi": "agilent.mi",
    "rsciio_test_surface_au.sur": "packed.sur",
    "sample_0.jpk-qi-image": "scan.jpk",
    "sur-2.sur": "plain.sur",
    "test_1.opd": "wyko.opd",
    "tmd-1.tmd": "truemap.tmd",
    "top-1.top": "wsxm.top",
    "valid_zygo_dat_file.dat": "zygo.dat",
}
