"""What `curve`, `conductance` and a resumed curve refuse is computed when their message is followed."""

import pytest

from followed import commands, follow_command

CURVE = "curve rough.npz --modulus 1GPa"
TWO = f"{CURVE} --forces 1mN,2mN"
NAMED = "curve rough.npz --materials steel,aluminium --forces 1mN,2mN"
YOUNG = "curve rough.npz --young 210GPa --poisson 0.3 --young2 70GPa --forces 1mN,2mN"
STICKS = "rough.npz --modulus 1GPa --work 1mJ/m^2 --range 100nm"
FAR = f"adhesion curve {STICKS}"
LOOP = f"adhesion loop {STICKS}"
LINE = "curve profile.txt --unit m --modulus 1GPa --profile line --forces 1N/m,2N/m"
SPRINGS = "curve profile.txt --unit m --modulus 1GPa --profile winkler --forces 1mN,2mN"

LOADS = f"""
$ {CURVE} --forces ''
! holds no load; write 1mN:1N:100 or a comma list
> {CURVE} --forces 1mN:1N:100
> {CURVE} --forces 1mN,2mN

$ {CURVE} --forces 1mN:2mN
! '1mN:2mN' is not a range; write from:to:count, such as 1mN:1N:100
> {CURVE} --forces 1mN:2mN:3
> {CURVE} --forces 1mN:1N:100

$ {CURVE} --forces 2mN:1mN:3
! must increase from a positive load, unlike '2mN:1mN:3'; write one such as 1mN:1N:100
> {CURVE} --forces 1mN:1N:100
> {CURVE} --forces 1mN:2mN:3

$ {CURVE} --forces 1mN:2mN:1
! a range holds from 2 to 100000 loads, not 1
> {CURVE} --forces 1mN:2mN:2

$ {CURVE} --forces 2mN,1mN
! the loads must increase from one to the next, unlike '2mN,1mN'; sort them
> {CURVE} --forces 1mN,2mN

$ {CURVE} --forces 0N,1mN
! every load must be positive, not 0 N; give positive loads only
> {CURVE} --forces 1mN
> {CURVE} --forces 1uN,1mN

$ {CURVE} --forces 1mN,2mN --depths 1nm,2nm
! --forces and --depths exclude each other: give one of them
> {CURVE} --forces 1mN,2mN
> {CURVE} --depths 1nm,2nm

$ {CURVE} --periodic --depths 1nm,1um
! give a smaller depth, or a force
> {CURVE} --periodic --depths 1nm,100nm
> {CURVE} --periodic --forces 1mN

$ curve profile.txt --unit m --modulus 1GPa --depths 1nm
! --profile line, as a line contact, or --profile winkler, on the springs
> curve profile.txt --unit m --modulus 1GPa --depths 1nm --profile line
> curve profile.txt --unit m --modulus 1GPa --depths 1nm --profile winkler

$ {SPRINGS} --hardness 1GPa
! leave it out, or take --profile line
> {SPRINGS}
> {LINE} --hardness 1GPa
"""

ADHESION = f"""
$ {CURVE} --forces 1uN,2uN --work 1mJ/m^2 --range 100nm
! use 'roughcontact adhesion curve' (
> {FAR} --forces 1uN,2uN

$ {FAR}
! is required: add one, such as --depths -20nm:20nm:9,-20nm
> {FAR} --depths -20nm:20nm:9,-20nm
> {FAR} --depths 1nm,2nm
> {FAR} --forces 1uN,2uN
> {FAR} --pressures 1kPa,2kPa
> {FAR} --mean-gaps 100nm,99nm --periodic

$ {LOOP} --depth 20nm --points 1
! --points: the number of steps must be a whole number from 2 to 10000, not '1'; give one such as 2
> {LOOP} --depth 20nm --points 2

$ {FAR} --depths 1nm:2nm
! write from:to:count, such as -20nm:20nm:41
> {FAR} --depths 1nm:2nm:3
> {FAR} --depths -20nm:20nm:41

$ {FAR} --forces -1nN,1nN
! begin with 0, followed by the tension
> {FAR} --forces 0N,-1nN

$ {FAR} --mean-gaps 100nm
! here the body is not periodic: give depths or forces
> {FAR} --depths 1nm
> {FAR} --forces 1uN

$ {FAR} --mean-gaps=-1nm,1nm --periodic
! -1 nm is full contact or beyond it; give mean gaps such as 100nm
> {FAR} --mean-gaps=2nm,1nm --periodic
"""

FLOW = f"""
$ {TWO} --loop
! --loop needs a hardness, which is not given; give --hardness, or both bodies as --materials
> {TWO} --loop --hardness 1GPa
> curve rough.npz --forces 1mN,2mN --loop --materials steel,aluminium

$ {CURVE} --depths 1nm,2nm --loop --hardness 1GPa
! --loop needs forces or pressures, because the depth is computed; give --forces
> {TWO} --loop --hardness 1GPa
> {CURVE} --pressures 1MPa,2MPa --loop --hardness 1GPa
"""

BESIDE = f"""
$ {TWO} --theory gravity
! there is no theory 'gravity'; choose from persson, finite-size, gw
> {TWO} --theory persson
> {TWO} --theory finite-size
> {TWO} --theory gw

$ {TWO} --theory gw,gw
! name each theory once, such as persson,finite-size
> {TWO} --theory persson,finite-size
> {TWO} --theory gw

$ {TWO} --theory hertz
! --theory hertz needs a radius, which cannot be measured on the surface; give --radius, such as 5mm
> {TWO} --theory hertz --radius 5mm

$ {TWO} --theory ceb
! --theory ceb needs a hardness, which cannot be measured on the surface; give --hardness, such as 2GPa or aluminium
> {TWO} --theory ceb --hardness 2GPa
> {TWO} --theory ceb --hardness aluminium

$ {TWO} --hurst 0.8
! --hurst needs --theory, which is not given: give --theory too
> {TWO} --hurst 0.8 --theory persson,gw

$ {TWO} --theory power-law --hurst 8
! the Hurst exponent must lie between -1 and 3
> {TWO} --theory power-law --hurst 0.8

$ {TWO} --table abaqus
! --table writes files: say where by --out
> {TWO} --table abaqus --out new

$ {TWO} --table ansys --out new
! there is no table 'ansys'; choose from csv, abaqus, abaqus-mm, calculix, calculix-mm, lammps, moose, text
> {TWO} --table csv --out new
> {TWO} --table abaqus --out new
> {TWO} --table abaqus-mm --out new
> {TWO} --table calculix --out new
> {TWO} --table calculix-mm --out new
> {TWO} --table lammps --out new
> {TWO} --table moose --out new
> {TWO} --table text --out new

$ {TWO} --table calculix --friction 0.3 --out new
! --friction needs the bodies: E* does not determine how they shear; name both by --materials, such as steel,aluminium
> curve rough.npz --materials steel,aluminium --forces 1mN,2mN --table calculix --friction 0.3 --out new

$ {TWO} --table csv,csv --out new
! name each table once, such as csv,abaqus
> {TWO} --table csv,abaqus --out new

$ {TWO} --table csv --table-area 1mm^2 --out new
! --table-area is for the table lammps: all other tables are per area; leave it out
> {TWO} --table csv --out new
> {TWO} --table lammps --table-area 1mm^2 --out new

$ {TWO} --resistivity 1nohm*m,2nohm*m,3nohm*m
! give one for both or two, such as 17nohm*m,17nohm*m, or names such as steel,aluminium
> {TWO} --resistivity 1nohm*m
> {TWO} --resistivity 17nohm*m,17nohm*m
> {TWO} --resistivity steel,aluminium

$ {TWO} --resistivity -1nohm*m
! the resistivity must not be negative, not '-1nohm*m'; give 0 or more
> {TWO} --resistivity 1nohm*m

$ {TWO} --frequency 5MHz
! --frequency needs two elastic bodies; E* does not determine the speed of sound: name both by --materials
> {NAMED} --frequency 5MHz

$ {NAMED} --frequency 5
! 5 without a unit is 5 Hz, no ultrasound; write 5MHz or, for a value in Hz, 5Hz
> {NAMED} --frequency 5MHz
> {NAMED} --frequency 5Hz

$ {NAMED} --frequency 5MHz --density 7.85
! write 7.85g/cm^3 or, for a value in kg/m^3, 7.85kg/m^3
> {NAMED} --frequency 5MHz --density 7.85g/cm^3

$ {NAMED} --density 7850kg/m^3
! --density needs --frequency, which is not given: give --frequency too
> {NAMED} --density 7850kg/m^3 --frequency 5MHz

$ {YOUNG} --poisson2 0.33 --frequency 5MHz
! --frequency and --young are given without --density; give --density, such as 7850kg/m^3,2700kg/m^3
> {YOUNG} --poisson2 0.33 --frequency 5MHz --density 7850kg/m^3,2700kg/m^3

$ {YOUNG} --poisson2 0.5 --frequency 5MHz --density steel,aluminium
! --poisson2 0.5 has an infinite speed of sound: give a smaller one, such as 0.49
> {YOUNG} --poisson2 0.49 --frequency 5MHz --density steel,aluminium

$ {LINE} --frequency 5MHz
! --frequency needs a map of heights, not a profile: leave it out
> {LINE}

$ {TWO} --unit-stiffness lbf --out new
! 'lbf' is not a unit of a stiffness per area; give one such as N/um/mm^2
> {TWO} --unit-stiffness N/um/mm^2 --out new

$ {LINE} --resistivity 17nohm*m
! it depends on the size of the bodies; leave out --resistivity and --conductivity
> {LINE}

$ {SPRINGS} --resistivity 17nohm*m
! a Winkler foundation only has a total conductance; give --of total
> {SPRINGS} --resistivity 17nohm*m --of total

$ {SPRINGS} --unit-stiffness N/um/mm^2
! on springs loads and stiffness are per length; leave them out
> {SPRINGS}

$ {TWO} --out taken
! taken is a file; choose another name
> {TWO} --out other

$ conductance new/curve.nc --resistivity 17nohm*m
! no such file; write one with: roughcontact curve ... --out DIR
> {TWO} --out new && conductance new/curve.nc --resistivity 17nohm*m

$ conductance rough.npz --resistivity 17nohm*m
! is not a curve.nc: write one with: roughcontact curve ... --out DIR
> {TWO} --out new && conductance new/curve.nc --resistivity 17nohm*m

$ conductance rough.npz
! give --resistivity, --conductivity, or both, such as --resistivity 17nohm*m
> {TWO} --out new && conductance new/curve.nc --resistivity 17nohm*m
> conductance new/curve.nc --conductivity 50W/(m*K)
> conductance new/curve.nc --resistivity 17nohm*m --conductivity 50W/(m*K)
"""


AIR = "--gas air,1bar,20degC,alpha=0.9:0.9"
BOTH = "--conductivity 50W/m/K"
HEAT = f"""
$ {TWO} {BOTH} --gas air,1bar,20degC
! lacks the accommodation coefficients of both bodies; \
write air,1bar,20degC,alpha=0.9:0.9
> {TWO} {BOTH} {AIR}

$ {TWO} {BOTH} --gas air,1,20degC,alpha=1
! '1' has no unit; write a pressure such as 1bar
> {TWO} {BOTH} --gas air,1bar,20degC,alpha=1

$ {TWO} {BOTH} --gas air,1bar,2bar,20degC,alpha=1
! states the pressure twice; leave one of them out
> {TWO} {BOTH} --gas air,2bar,20degC,alpha=1

$ {TWO} {BOTH} --gas air,1bar,20degC,beta=1
! a gas has no 'beta'; write alpha=0.9:0.9 for the accommodation coefficients
> {TWO} {BOTH} --gas air,1bar,20degC,alpha=0.9:0.9

$ {TWO} {BOTH} --gas air,1bar,20degC,alpha=1:1:1
! contains 3 values for two bodies; give one for both, such as 0.9, or two, such as 0.9:0.9
> {TWO} {BOTH} --gas air,1bar,20degC,alpha=0.9
> {TWO} {BOTH} --gas air,1bar,20degC,alpha=0.9:0.9

$ {TWO} {BOTH} --gas air,1bar,900K,alpha=1
! --gas: the temperature must be between 200 and 600 K
> {TWO} {BOTH} --gas air,1bar,600K,alpha=1

$ {TWO} {AIR}
! --gas needs the conductivity of the bodies; give --conductivity, such as 400W/m/K or steel,aluminium
> {TWO} {AIR} --conductivity 400W/m/K
> {TWO} {AIR} --conductivity steel,aluminium

$ {TWO} {AIR} --conductivity 0,50W/m/K
! an insulator has no conductance; give conductivities above 0, such as 400W/m/K
> {TWO} {AIR} --conductivity 400W/m/K

$ {TWO} {BOTH} --emissivity 0.2
! radiation depends on the temperature; give --temperature, such as 20degC
> {TWO} {BOTH} --emissivity 0.2 --temperature 20degC

$ {TWO} {BOTH} {AIR} --emissivity 0.2 --temperature 20degC
! the gas has a temperature already; leave --temperature out
> {TWO} {BOTH} {AIR} --emissivity 0.2

$ {TWO} {BOTH} {AIR} --of total
! --gas does not go with --of; leave --of out
> {TWO} {BOTH} {AIR}

$ {TWO} {BOTH} --film 1e-7m^2*K/W --loop --hardness 100MPa
! --film does not go with --loop; leave --film out
> {TWO} {BOTH} --loop --hardness 100MPa

$ {SPRINGS} {BOTH} {AIR} --of total
! --gas does not go with --profile; leave --gas out
> {SPRINGS} {BOTH} --of total
"""


@pytest.mark.parametrize("refusal", commands(LOADS, ADHESION, FLOW, BESIDE, HEAT))
def test_curve(command, refusal):
    follow_command(command, refusal)
