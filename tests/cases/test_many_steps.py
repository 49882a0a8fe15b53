"""Marches whose film velocities pass zero, where derivatives depend on directions alone, do not crawl."""

import subprocess

import pytest

# load on a pad, no preload, centred pivots: from `partial`, side pads slide at half the shaft's speed and
# rub. Iterations without a test stay at 0.16 s and 0.25 s, at steps of 1e-8 s.
BEARING = """
&case title = 'side pads that flutter' /
&rotor mass = {mass}, unbalance = 0.0 /
&operation speed_rpm = {rpm}, duration = {duration} /
&bearing journal_radius = {radius}, axial_length = {length},
   assembled_clearance = {clearance}, preload = 0.0,
   viscosity = {viscosity} /
&pads pivot_angle_deg = -90.0, 0.0, 90.0, 180.0, arc_deg = {arc}, pivot_ratio = 0.5,
   motion = 'tilting_radial',
   density = 7850, thickness = {thickness}, pivot_distance = {thickness} /
&pivot socket_radius = {socket}, radius_difference = {difference},
   law = 'fang', deflection_factor = 6.283185307179586 /
&film cavitation = 'reynolds', solver = 'direct' /
&friction model = 'none' /
&asperity roughness = {roughness} /
&start from = 'partial' /
"""
BEARINGS = {
    "small": {
        "mass": 281.8477447400032,
        "rpm": 7570.562238620784,
        "duration": 0.18,
        "radius": 0.07219286169036963,
        "length": 0.07862420693847222,
        "clearance": 6.440787437554612e-05,
        "viscosity": 0.014667728653799023,
        "arc": 80.0,
        "thickness": 0.027335440483950684,
        "socket": 0.012066209211447096,
        "difference": 4.547190854081529e-05,
        "roughness": 3.065648487630001e-07,
    },
    "large": {
        "mass": 787.1192784399908,
        "rpm": 2499.202590896922,
        "duration": 0.26,
        "radius": 0.07755566927653582,
        "length": 0.12807171133784948,
        "clearance": 5.322372792229921e-05,
        "viscosity": 0.020626166685819913,
        "arc": 70.07236606588266,
        "thickness": 0.03211252473619832,
        "socket": 0.04308708903966861,
        "difference": 0.00017367036781767138,
        "roughness": 4.6713948625375654e-07,
    },
}
STEPS_OF_A_REVOLUTION = 2000


@pytest.mark.parametrize("bearing", BEARINGS)
def test_films_at_rest_are_passed(program, tmp_path, bearing):
    values = BEARINGS[bearing]
    (tmp_path / "case.nml").write_text(BEARING.format(**values))
    most = int(STEPS_OF_A_REVOLUTION * values["rpm"] / 60 * values["duration"])
    run = subprocess.run(
        [program, "case.nml", "--quiet", "--set", f"integration%max_steps={most}"],
        check=False,
        cwd=tmp_path,
        capture_output=True,
        text=True,
        timeout=300,
    )
    assert run.returncode == 0, run.stderr
