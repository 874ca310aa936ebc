"""What `surface` refuses is made, prepared or measured when its message is followed."""

import pytest

from followed import commands, follow_command

MAKE = "surface make new.npz --rms 1um --size 1mm --hurst 0.8 --points 32"
BARE = "surface make new.npz --rms 1um --size 1mm"
PREPARE = "surface prepare rough.npz new.npz"

MADE = f"""
$ {BARE} --hurst 8 --points 32
! the Hurst exponent must lie between -1 and 3, not '8'; give a number such as 0.8
> {BARE} --hurst 0.8 --points 32

$ {BARE} --hurst 0.8 --points 6.4
! write 512 or 512x256 (rows x columns)
> {BARE} --hurst 0.8 --points 512
> {BARE} --hurst 0.8 --points 512x256

$ {MAKE} --seed x
! the seed must be a whole number from 0 up, not 'x'; give one such as 2
> {MAKE} --seed 2

$ {MAKE} --rms-band 1mm
! write the longest and the shortest wave, such as 1mm:10um
> {MAKE.replace("32", "512")} --rms-band 1mm:10um

$ {MAKE} --rms-band 100um:1mm
! exchange them: 1mm:100um
> {MAKE} --rms-band 1mm:100um

$ surface make new.docx --hurst 0.8 --rms 1um --size 1mm --points 32
! a Surface is written as one of .npz, .nc, .x3p, .txt, .npy, .vti
> surface make new.npz --hurst 0.8 --rms 1um --size 1mm --points 32
> surface make new.nc --hurst 0.8 --rms 1um --size 1mm --points 32
> surface make new.x3p --hurst 0.8 --rms 1um --size 1mm --points 32
> surface make new.txt --hurst 0.8 --rms 1um --size 1mm --points 32
> surface make new.npy --hurst 0.8 --rms 1um --size 1mm --points 32
> surface make new.vti --hurst 0.8 --rms 1um --size 1mm --points 32
"""

PREPARED = f"""
$ surface prepare rough.npz rough.npz --level plane
! rough.npz is the measured file itself: name another file to write
> surface prepare rough.npz new.npz --level plane

$ {PREPARE} --crop 0:5
! --crop: a crop needs one slice an axis, 2 in all, not 1; give rows and columns
> {PREPARE} --crop 0:5,0:8

$ {PREPARE} --crop a:b
! write rows,columns such as 0:40,5:45, or 0:40 for a profile
> {PREPARE} --crop 0:5,0:8
> surface prepare profile.txt new.npz --unit m --crop 0:32

$ {PREPARE} --mask round
! write above=3um, below=-3um, box=0:9,10:30 or ellipse=0:9,10:30
> {PREPARE} --mask box=0:9,10:30
> {PREPARE} --mask ellipse=0:9,10:30
> {PREPARE} --mask above=3um
> {PREPARE} --mask below=-3um

$ {PREPARE} --form cone
! write a degree from 0 to 12, sphere or cylinder
> {PREPARE} --form 0
> {PREPARE} --form 12
> {PREPARE} --form sphere
> {PREPARE} --form cylinder

$ {PREPARE} --tip 2
! a radius of 2 m is too large for a tip; write it with its unit, such as 2um
> {PREPARE} --tip 2um

$ {PREPARE} --tip-shape sphere
! --tip-shape needs --tip, which is not given: give --tip too
> {PREPARE} --tip-shape sphere --tip 2um

$ {PREPARE} --short-cutoff 10
! leaves nothing of a map of 48 um; give a shorter one, such as 1e-5 m
> {PREPARE} --short-cutoff '1e-5 m'
> {PREPARE} --short-cutoff 10um

$ {PREPARE} --short-cutoff 1nm
! too short for cells of 2 um; give at least 8 um
> {PREPARE} --short-cutoff 8um

$ {PREPARE} --short-cutoff 20um --long-cutoff 10um
! the short cut-off of 20 um must be below the long one of 10 um; exchange them
> {PREPARE} --short-cutoff 10um --long-cutoff 20um

$ {PREPARE} --average 0
! --average: the number of cells must be a whole number from 1 up, not '0'; give one such as 2
> {PREPARE} --average 2
> {PREPARE} --average 1

$ {PREPARE} --downsample 20
! a factor of 20 leaves less than two of 24 cells; give at most 12
> {PREPARE} --downsample 12

$ {PREPARE} --alias
! --alias needs --downsample, which is not given: give --downsample too
> {PREPARE} --alias --downsample 2

$ {PREPARE} --share 0.5
! --share needs --window, which is not given: give --window too
> {PREPARE} --share 0.5 --window tukey

$ {PREPARE} --window tukey --share 2
! must lie between 0 and 1, not '2'; give a number such as 0.25
> {PREPARE} --window tukey --share 0.25
> {PREPARE} --window tukey --share 1
"""

MEASURED = """
$ surface info missing.npz
! check the path and the permissions
> surface info rough.npz

$ surface info bare.npy
! pass --unit with the unit of the heights, such as --unit 'um' and --size
> surface info bare.npy --unit 'um' --size '500 um'

$ surface info profile.txt
! it states no unit of its heights; pass --unit with the unit of the heights, such as --unit 'um'
> surface info profile.txt --unit 'um'

$ surface spectrum holed.npz
! add --fill, or crop them away by 'roughcontact surface prepare'
> surface spectrum holed.npz --fill
> surface prepare holed.npz new.npz --crop 4:16,0:16 && surface spectrum new.npz

$ surface spectrum rough.npz --shortest 1mm --longest 1um
! the longest wave, 1um, must be longer than the shortest, 1mm; exchange the two
> surface spectrum rough.npz --shortest 1um --longest 1mm

$ surface spectrum rough.npz --shortest 1nm --longest 2nm
! the spectrum has 130900 to 1.55573e+06 rad/m, waves from 48 um down to 4.04 um
> surface spectrum rough.npz --longest 48um --shortest 4.04um

$ thesis fig1
! choose one of fig3, fig4
> thesis list
> thesis fig4

$ thesis fig4 --scale huge
! choose from small, thesis
> thesis fig4 --scale small
> thesis fig4 --scale thesis
"""


@pytest.mark.parametrize("refusal", commands(MADE, PREPARED, MEASURED))
def test_surface(command, refusal):
    follow_command(command, refusal)
