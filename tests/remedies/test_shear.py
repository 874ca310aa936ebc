"""What the command `shear` refuses is computed when the message is followed."""

import pytest

from followed import commands, follow_command

BODIES = "--materials steel,steel"
SHEAR = f"shear rough.npz {BODIES} --friction 0.2 --pressures"
COMMANDS = f"""
$ shear rough.npz --modulus 110GPa --friction 0.2 --pressures 10MPa
! --modulus: shear needs Poisson's ratios, which a reduced modulus does not contain
! give --materials, such as steel,aluminium, or --young and --poisson
> shear rough.npz --materials steel,aluminium --friction 0.2 --pressures 10MPa
> shear rough.npz --young 110GPa --poisson 0.3 --friction 0.2 --pressures 10MPa

$ shear rough.npz {BODIES} --pressures 10MPa
! --friction is required: add it, such as --friction 0.2
> {SHEAR} 10MPa

$ shear rough.npz {BODIES} --friction 0.2
! --pressures is required: add it, such as --pressures 1MPa,5MPa,10MPa
> {SHEAR} 1MPa,5MPa,10MPa

$ shear rough.npz {BODIES} --friction 0.2 --pressure 10MPa
! --pressure: this command has no such option; did you mean --pressures
> {SHEAR} 10MPa

$ shear rough.npz {BODIES} --friction 0 --pressures 10MPa
! --friction: the coefficient of friction must lie between 0 and 10 (both excluded), not '0'; give a number such as 0.2
> {SHEAR} 10MPa

$ {SHEAR} 10N
! write a pressure such as 1MPa
> {SHEAR} 1MPa

$ {SHEAR} 10MPa --amplitude 1.2
! --amplitude: the amplitude must lie between 0.001 and 1, not '1.2'; give a number such as 0.5
> {SHEAR} 10MPa --amplitude 0.5

$ {SHEAR} 10MPa --amplitude ,
! --amplitude: ',' holds no amplitude; write 0.5 or a comma list such as 0.1,0.5
> {SHEAR} 10MPa --amplitude 0.5
> {SHEAR} 10MPa --amplitude 0.1,0.5

$ {SHEAR} 10MPa --amplitude 1
! give a smaller amplitude, or use a curve with smaller loads, of a periodic map without missing cells
> {SHEAR} 10MPa --amplitude 0.9
> {SHEAR} 10MPa --amplitude 1 --periodic

$ {SHEAR} 10MPa --after 1MPa --hardness 2GPa
! --after 1MPa is not larger than the pressures: leave it out, or give a larger one
> {SHEAR} 10MPa --hardness 2GPa
> {SHEAR} 10MPa --after 20MPa --hardness 2GPa

$ {SHEAR} 10MPa --hardness 5MPa
! --pressures: a force of
! the most that all measured cells can carry at this hardness; press by less, or give a greater hardness
> {SHEAR} 1MPa --hardness 5MPa
> {SHEAR} 10MPa --hardness 5GPa

$ {SHEAR} 0MPa
! --pressures: every load must be positive, not 0 Pa; give positive loads only
> {SHEAR} 1MPa

$ {SHEAR} 10MPa:1MPa:3
! unlike '10MPa:1MPa:3'; write one such as 1kPa:1MPa:100
> {SHEAR} 1kPa:1MPa:100

$ {SHEAR} 10MPa --profile line
! --profile: shear needs a map of heights; leave --profile out
> {SHEAR} 10MPa

$ {SHEAR} 10MPa,1000GPa
! --pressures: the law of this curve ends at
! give lower pressures
> {SHEAR} 10MPa,1GPa

$ {SHEAR} 1e16Pa
! press the map by more loads, from small ones on, none of them in full contact
> {SHEAR} 10MPa
"""


@pytest.mark.parametrize("refusal", commands(COMMANDS))
def test_the_command_works_when_its_remedy_is_followed(command, refusal):
    follow_command(command, refusal)
