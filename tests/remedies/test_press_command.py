"""What the command `press` refuses is pressed when its message is followed."""

import pytest

from followed import commands, follow_command

PRESS = "press rough.npz --modulus 1GPa"
FORCE = "press rough.npz --force 1mN"
BARE = "press bare.npy --force 1mN --modulus 1GPa"
PROFILE = "press profile.txt --unit m --modulus 1GPa --force 1N/m"
FAR = "adhesion press rough.npz --modulus 1GPa --work 1mJ/m^2 --range 100nm"
DETACH = "adhesion detach rough.npz --modulus 1GPa --work 1mJ/m^2"
NEAR = "adhesion press rough.npz --modulus 1GPa --work 50mJ/m^2"
FLOWS = f"{PRESS} --force 1mN --hardness 1GPa"

LOADS = f"""
$ {PRESS}
! --force, --pressure or --depth is required: add one, such as --force 10N
> {PRESS} --force 10N
> {PRESS} --force 1mN
> {PRESS} --pressure 1MPa
> {PRESS} --depth 10nm

$ {PRESS} --force 1mN --depth 1nm
! --force and --depth exclude each other: give one of them
> {PRESS} --force 1mN
> {PRESS} --depth 1nm

$ {PRESS} --force 0N
! --force: the force must be positive, not '0N'
> {PRESS} --force 1uN

$ {PRESS} --force 0,5N
! write the decimal point as '.'; write a force such as 10N
> {PRESS} --force 0.5N
> {PRESS} --force 10N

$ {PRESS} --force 1kg
! '1kg' is not a force; write a force such as 10N
> {PRESS} --force 10N

$ {PRESS} --force much
! 'much' does not start with a number; write a force such as 10N
> {PRESS} --force 10N

$ {PRESS} --force 1newt
! unknown unit 'newt' in '1newt'; write a force such as 10N
> {PRESS} --force 10N

$ {PRESS} --force 1e300N
! check its exponent and unit; write a force such as 10N
> {PRESS} --force 10N

$ {PRESS} --depth -1um
! the depth is measured from first touch, and '-1um' is negative; give 0 or more
> {PRESS} --depth 0um

$ {PRESS} --periodic --depth 1um
! give a smaller depth, or a force
> {PRESS} --periodic --depth 100nm
> {PRESS} --periodic --force 1mN

$ {PRESS} --force 1mN --tolerance 1
! the tolerance must lie between 1e-14 and 0.01 (both excluded), not '1'; give a number such as 1e-8
> {PRESS} --force 1mN --tolerance 1e-8
> {PRESS} --force 1mN --tolerance 1e-3

$ {PRESS} --force 1mN --hardness 1kPa
! --force: a force of 1 mN exceeds
! all measured cells can carry at this hardness
> {PRESS} --force 1.5uN --hardness 1kPa
> {FLOWS}
"""

BODIES = f"""
$ {FORCE}
! --modulus, --materials or --young is required: add one, such as --modulus 110GPa
> {FORCE} --modulus 110GPa
> {FORCE} --materials steel,aluminium
> {FORCE} --young 210GPa --poisson 0.3

$ {FORCE} --modulus 0GPa
! --modulus: the reduced modulus must be positive
> {FORCE} --modulus 1GPa

$ {FORCE} --modulus 110
! write 110GPa or, for a value in Pa, 110Pa
> {FORCE} --modulus 110GPa
> {FORCE} --modulus 110Pa

$ {FORCE} --modulus steel
! --modulus: 'steel' is a name, but the reduced modulus is a number; name both bodies by --materials, such as
> {FORCE} --materials steel,aluminium
> {FORCE} --materials steel,rigid

$ {FORCE} --young steel --poisson 0.3
! --young: 'steel' is a name, but Young's modulus is a number; name both bodies by --materials, such as steel,aluminium
> {FORCE} --materials steel,steel

$ {FORCE} --modulus 1N
! '1N' is not a modulus; write a modulus such as 110GPa
> {FORCE} --modulus 110GPa

$ {FORCE} --modulus 1GPa --poisson 0.3
! --poisson needs --young, which is not given: give --young too
> {FORCE} --young 1GPa --poisson 0.3
> {FORCE} --modulus 1GPa

$ {FORCE} --modulus 1GPa --young 1GPa
! --modulus and --young exclude each other
> {FORCE} --modulus 1GPa
> {FORCE} --young 1GPa --poisson 0.3

$ {FORCE} --young 1GPa
! --young is given without --poisson; give --poisson, such as 0.3
> {FORCE} --young 1GPa --poisson 0.3

$ {FORCE} --young 1GPa --poisson 0.3 --young2 1GPa
! --young2 is given without --poisson2; give --poisson2, such as 0.3
> {FORCE} --young 1GPa --poisson 0.3 --young2 1GPa --poisson2 0.3

$ {FORCE} --young 1GPa --poisson 0.7
! must lie between -0.99 and 0.5, not '0.7'; give a number such as 0.3
> {FORCE} --young 1GPa --poisson 0.3
> {FORCE} --young 1GPa --poisson 0.5

$ {FORCE} --young 1GPa --poisson third
! 'third' is not a number; write a number such as 0.3
> {FORCE} --young 1GPa --poisson 0.3

$ {FORCE} --materials steel
! name both, such as steel,aluminium or steel,steel or steel,rigid
> {FORCE} --materials steel,aluminium
> {FORCE} --materials steel,steel
> {FORCE} --materials steel,rigid

$ {FORCE} --materials rigid,rigid
! one of the two bodies must be elastic; name a material, such as steel,rigid
> {FORCE} --materials steel,rigid

$ {FORCE} --materials steel,oak
! tungsten; give the numbers of the material, such as --young 210GPa --poisson 0.3
> {FORCE} --materials steel,tungsten
> {FORCE} --young 205GPa --poisson 0.29 --young2 11GPa --poisson2 0.4

$ {FORCE} --materials steel,210GPa
! give a number of yours as --young or --modulus
> {FORCE} --young 210GPa --poisson 0.3
> {FORCE} --modulus 210GPa

$ {PRESS} --force 1mN --hardness 2
! write 2GPa or, for a value in Pa, 2Pa
> {PRESS} --force 1mN --hardness 2GPa

$ {PRESS} --force 1mN --hardness butter
! there are steel, stainless-steel, aluminium
> {PRESS} --force 1mN --hardness steel
> {PRESS} --force 1mN --hardness 3MPa
"""

READING = f"""
$ press rouhg.npz --modulus 1GPa --force 1mN
! rouhg.npz: it cannot be opened (No such file or directory); check the path
> {PRESS} --force 1mN

$ press . --force 1mN --modulus 1GPa
! it is a folder; name a file in it
> {PRESS} --force 1mN

$ {BARE}
! pass --unit with the unit of the heights, such as --unit 'um' and --size with the width or height x width,
! such as --size '500 um' or --size '4e-4 x 5e-4'
> {BARE} --unit 'um' --size '500 um'
> {BARE} --unit 'um' --size '4e-4 x 5e-4'

$ {BARE} --unit nm
! it states no size; pass --size with
> {BARE} --unit nm --size '500 um'

$ {BARE} --unit parsec2 --size 1mm
! use km, m, cm, mm, um, nm, angstrom or pm, or a number of metres
> {BARE} --unit nm --size 1mm
> {BARE} --unit 1e-9 --size 1mm

$ {BARE} --unit nm --size '1mm x 2'
! write '1 x 2mm' or '1mm x 2mm'
> {BARE} --unit nm --size '1 x 2mm'
> {BARE} --unit nm --size '1mm x 2mm'

$ {BARE} --unit nm --size 1x2x3mm
! holds 3 lengths; write '1mm' or '1mm x 2mm'
> {BARE} --unit nm --size '1mm'
> {BARE} --unit nm --size '1mm x 2mm'

$ {BARE} --unit nm --size 0mm
! --size: a side length must be positive
> {BARE} --unit nm --size 1mm

$ {PRESS} --force 1mN --channel colour
! only 'heights' (24 x 32, no unit); pass --channel with one of these names
> {PRESS} --force 1mN --channel heights

$ {PRESS} --force 1mN --level plan
! 'plan' is not one of the choices; did you mean 'plane'? choose from none, mean, plane, quadratic
> {PRESS} --force 1mN --level plane
> {PRESS} --force 1mN --level mean
> {PRESS} --force 1mN --level none
> {PRESS} --force 1mN --level quadratic

$ press profile.txt --unit m --modulus 1GPa --depth 10nm
! --profile line, as a line contact, or --profile winkler, on the springs
> press profile.txt --unit m --modulus 1GPa --depth 10nm --profile line
> press profile.txt --unit m --modulus 1GPa --depth 10nm --profile winkler

$ press profile.txt --unit m --modulus 1GPa --force 1N --profile line
! write a force per length such as 10N/mm
> press profile.txt --unit m --modulus 1GPa --force 10N/mm --profile line

$ {PRESS} --force 1N/m --profile line
! holds a map of 24 x 32 heights; leave out --profile
> {PRESS} --force 1N

$ press profile.txt --unit m --modulus 1GPa --depth 10nm --profile winkler --hardness 1GPa
! leave it out, or take --profile line
> press profile.txt --unit m --modulus 1GPa --depth 10nm --profile winkler
> press profile.txt --unit m --modulus 1GPa --depth 10nm --profile line --hardness 1GPa

$ press profile.txt --unit m --modulus 1GPa --depth 10nm --profile winkler --unit-stiffness N/um/mm^2
! on springs loads and stiffness are per length; leave them out
> press profile.txt --unit m --modulus 1GPa --depth 10nm --profile winkler

$ {PRESS} --force 1mN --unit-stiffness lbf
! 'lbf' is not a unit of a stiffness per area; give one such as N/um/mm^2
> {PRESS} --force 1mN --unit-stiffness N/um/mm^2

$ {PROFILE} --profile line --errors
! --errors are those of a map of heights, not of a profile: leave it out
> {PROFILE} --profile line
"""

ADHESION = f"""
$ {PRESS} --force 1uN --work 1mJ/m^2 --range 100nm
! use 'roughcontact adhesion press' (
> {FAR} --force 1uN

$ {FAR}
! --force, --pressure, --depth or --mean-gap is required: add one, such as --force 10mN
> {FAR} --force 1uN
> {FAR} --pressure 1kPa
> {FAR} --depth 1nm
> {FAR} --mean-gap 100nm --periodic

$ {NEAR} --force 1uN --range 2nm
! at most 16.9 nm or a range of at least 21.8 nm, use 'roughcontact adhesion detach', which needs no range, or give
> {NEAR} --force 1nN --range 2nm --size '405.6nm x 540.8nm'
> {NEAR} --force 1uN --range 21.8nm
> {DETACH} --force 1uN
> {NEAR} --force 1uN --range 2nm --allow-unresolved

$ {FAR} --force -1nN
! compute an adhesion curve with --forces 0,-1nN
> adhesion curve rough.npz --modulus 1GPa --work 1mJ/m^2 --range 100nm --forces 0,-1nN

$ {FAR} --pressure -1Pa
! compute an adhesion curve with --pressures 0,-1Pa
> adhesion curve rough.npz --modulus 1GPa --work 1mJ/m^2 --range 100nm --pressures 0,-1Pa

$ {FAR} --mean-gap 100nm
! here the body is not periodic: give depths or forces
> {FAR} --depth 1nm
> {FAR} --force 1uN

$ {FAR} --force 1uN --hardness 1GPa
! use 'roughcontact press' (
> {PRESS} --force 1uN --hardness 1GPa
"""

STUCK = f"""
$ {DETACH} --depth 0nm
! nothing is in contact in this solution: press to a force or a depth above zero
> {DETACH} --depth 10nm
> {DETACH} --force 1uN

$ {DETACH} --depth 10nm --depths 20nm
! press to that depth, or begin with 1e-08 or less
> {DETACH} --depth 20nm --depths 20nm
> {DETACH} --depth 10nm --depths 1e-08

$ {DETACH} --depth 10nm --depths=-5nm,5nm
! leave it out, or compute an adhesion curve
> {DETACH} --depth 10nm --depths=-5nm
> adhesion curve rough.npz --modulus 1GPa --work 1mJ/m^2 --range 100nm --depths=-5nm,5nm

$ {DETACH} --depth 10nm --depths 5nm --forces 0N
! --depths and --forces exclude each other: give one of them
> {DETACH} --depth 10nm --depths 5nm
> {DETACH} --depth 10nm --forces 0N
"""

FLOW = f"""
$ {PRESS} --force 1mN --after 2mN
! which is not given; give --hardness, or both bodies as --materials
> {FLOWS} --after 2mN
> {FORCE} --materials steel,aluminium --after 2mN

$ {FLOWS} --after 0.5mN
! leave it out, or exchange the two loads
> {FLOWS}
> {PRESS} --force 0.5mN --hardness 1GPa --after 1mN

$ {FLOWS} --after 2mN --errors
! --errors does not go with --after: other maps are pressed by the same load only
> {FLOWS} --after 2mN
> {FLOWS} --errors

$ {PRESS} --force 1mN --flow raised
! which is not given; give --hardness, or both bodies as --materials
> {FLOWS} --flow raised

$ {FLOWS} --flow raised --errors
! --errors does not go with --flow
> {FLOWS} --flow raised
> {FLOWS} --errors

$ {PRESS} --flow raised --depth 10nm --hardness 1GPa
! if the surface rises as it flows: give forces or pressures
> {FLOWS} --flow raised
> {PRESS} --pressure 1MPa --hardness 1GPa --flow raised
"""

WRITING = f"""
$ {PRESS} --force 1mN --format svg
! --format is that of pictures: say where by --out
> {PRESS} --force 1mN --format svg --out new

$ {PRESS} --force 1mN --theory persson
! --theory draws a picture: say where by --out
> {PRESS} --force 1mN --theory persson --out new

$ {PROFILE} --profile line --theory persson --out new
! not of a profile: leave it out
> {PROFILE} --profile line --out new

$ {PRESS} --force 1mN --out taken
! taken is a file; choose another name
> {PRESS} --force 1mN --out other

$ {PRESS} --force 1mN --out taken/inside
! taken is a file; choose another name
> {PRESS} --force 1mN --out other/inside

$ {PRESS} --force 1mN --shortest-wave 10um
! --shortest-wave needs --errors, which is not given: give --errors too
> {PRESS} --force 1mN --shortest-wave 10um --errors
"""


@pytest.mark.parametrize("refusal", commands(LOADS, BODIES, READING, ADHESION, STUCK, FLOW, WRITING))
def test_press(command, refusal):
    follow_command(command, refusal)
