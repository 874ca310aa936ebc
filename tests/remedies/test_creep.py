"""What the command `creep` refuses is computed when the message is followed."""

import pytest

import roughcontact as rc
from followed import commands, follow_command

CREEP = "creep rough.npz --steps 2 --material rubber.toml --history"
LINE = CREEP.replace("rough.npz", "profile.txt --unit m --profile line")
COMMANDS = f"""
$ creep rough.npz --history 0s:0N,1s:1uN
! --material is required: add it, such as --material rubber.toml
> {CREEP} 0s:0N,1s:1uN

$ creep rough.npz --material rubber.toml
! --history is required: add it, such as --history 0s:0N,1s:10N,1000s:10N
> {CREEP} 0s:0N,1s:1uN,1000s:1uN

$ {CREEP} 0:0,1:1
! --history: the load 1 has no unit; write 1N, 1Pa or 1m
> {CREEP} 0:0,1:1N
> {CREEP} 0:0,1:1Pa

$ {CREEP} 0s:0N,1s:1kPa
! --history: 0N and 1kPa are loads of two kinds; give only forces, only pressures, or only depths
> {CREEP} 0s:0Pa,1s:1kPa
> {CREEP} 0s:0N,1s:1uN

$ {CREEP} 1s:0N,0s:1uN
! --history: times must not decrease, but 0 s follows 1 s; sort them; two equal times are a jump
> {CREEP} 0s:1uN,1s:0N
> {CREEP} 1s:0N,1s:1uN

$ {CREEP} 1uN,2uN
! --history: '1uN' is not a time with a load; write time:load, such as 0s:0N,1s:10N,1000s:10N
> {CREEP} 0s:1uN,1s:2uN

$ {CREEP} 1s:1uN
! --history: '1s:1uN' holds fewer than two times; write two or more, such as
> {CREEP} 0s:0N,1s:1uN

$ {CREEP} 0s:0N,1s:1J
! --history: '1J' is neither a force nor a pressure nor a depth; write a load such as 10N, 10kPa or 1um
> {CREEP} 0s:0Pa,1s:1kPa

$ {CREEP} 0s:0N,1s:-1uN
! --history: a load of -1e-06 N is a tension, but without adhesion surfaces do not pull; give 0 or more
> {CREEP} 0s:0N,1s:1uN

$ {CREEP} 0:0,1:0
! --history: all loads are 0; give a load
> {CREEP} 0:0,1:1uN

$ {CREEP} 0s:0N/m,1s:1N/m
! --history: the loads are those of a force per length, but a map of heights has no such loads; write loads such as
> {CREEP} 0s:0N,1s:1uN

$ {LINE} 0s:0N,1s:1N
! --history: the loads are those of a force, but a line contact has forces per length; write loads such as 10N/mm
> {LINE} 0s:0N/mm,1s:1uN/mm

$ {CREEP.replace("rubber", "damped")} 0s:0nm,0s:1nm
! --history: the depth jumps, and a material with a dashpot needs an infinite force for this; let the depth change
> {CREEP.replace("rubber", "damped")} 0s:0nm,1s:1nm
> {CREEP} 0s:0nm,0s:1nm

$ {CREEP.replace("rubber", "gel")} 0s:0N,99s:1uN
! --history: the history lasts 99 s, and the data of the material end at 10 s; change the times
> {CREEP.replace("rubber", "gel")} 0s:0N,9s:1uN

$ {CREEP.replace("rubber", "gel")} 0s:0N,0.01s:1uN
! --history: the time 0.01 s follows 0.01 s after a change of the rate of the load, and the data of the material begin
> {CREEP.replace("rubber", "gel")} 0s:0N,0.1s:1uN

$ {CREEP} 0s:0N,1s:1uN --hardness 1GPa
! --hardness: plastic flow together with viscoelasticity is not modelled; leave it out
> {CREEP} 0s:0N,1s:1uN

$ {CREEP} 0s:0N,1s:1uN --work 1mJ/m^2
! --work: adhesion together with viscoelasticity is not modelled; leave it out
> {CREEP} 0s:0N,1s:1uN

$ {CREEP} 0s:0N,1s:1uN --time-tolerance 1e-2
! --time-tolerance and --steps exclude each other: give one of them
> {CREEP} 0s:0N,1s:1uN
> creep rough.npz --time-tolerance 0.1 --material rubber.toml --history 0s:0N,1s:1uN

$ creep rough.npz --time-tolerance 1e-8 --material rubber.toml --history 0s:0N,1s:1uN
! give a larger time_tolerance, or a smaller tolerance
> creep rough.npz --time-tolerance 0.1 --material rubber.toml --history 0s:0N,1s:1uN

$ {LINE} 0s:0nm,1s:1nm --leak 0
! --leak does not go with --profile: it needs a map of heights; leave out one of them
> {LINE} 0s:0nm,1s:1nm
> {CREEP} 0s:0nm,1s:1nm --leak 0

$ {CREEP.replace("rubber", "none")} 0s:0nm,1s:1nm
! none.toml: it cannot be opened (No such file or directory); check the path
> {CREEP} 0s:0nm,1s:1nm

$ run plastic.toml
! recipe.plastic: plastic flow together with viscoelasticity is not modelled; leave it out
> run elastic.toml
"""
RECIPE = """job = "creep"
[source]
file = "rough.npz"
[history]
history = "0s:0nm,1s:1nm"
[bodies]
material = "rubber.toml"
[contact]
steps = "2"
"""


@pytest.fixture
def materials(folder):
    rc.viscoelastic.standard_solid(1e9, 2e9, 1.0).write("rubber.toml")
    rc.viscoelastic.kelvin_voigt(1e9, 1e9).write("damped.toml")
    rc.Viscoelastic(1e9, (1e9,), (1.0,), band=(0.1, 10.0)).write("gel.toml")
    (folder / "elastic.toml").write_text(RECIPE)
    (folder / "plastic.toml").write_text(f"{RECIPE}[plastic]\nhardness = '1GPa'\n")


@pytest.mark.usefixtures("materials")
@pytest.mark.parametrize("refusal", commands(COMMANDS))
def test_commands(command, refusal):
    follow_command(command, refusal)
