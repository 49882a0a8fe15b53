"""Names of datasets and groups in files of format_version 2, with today's: the only place that knows them.

A row is a path; of what is in a group that has another name today, with today's name of the group.
"""

FORMER_NAMES = {
    # of runs
    "pad_penetration": "pivot_deflection",
    "pad_penetration_rate": "pivot_deflection_rate",
    "contact_force": "pivot_load",
    "equilibrium/pad_penetration": "equilibrium/pivot_deflection",
    "equilibrium/contact_force": "equilibrium/pivot_load",
    "equilibrium/pressure_loss": "equilibrium/poiseuille_loss",
    "special_points": "bifurcations",
    "statistics/film_modal": "statistics/film_fourier",
    # of studies
    "equilibrium_y": "equilibrium_journal_y",
    "equilibrium_z": "equilibrium_journal_z",
    "sommerfeld_number": "equilibrium_sommerfeld_number",
    "specific_load": "equilibrium_specific_load",
    "equilibrium_power_loss": "equilibrium_total_power_loss",
    "equilibrium_inlet_flow": "equilibrium_total_inlet_flow",
    "equilibrium_side_flow": "equilibrium_total_side_flow",
}


def renamed(path: str) -> str:
    """Today's path of a dataset or group that may be called by a former one."""
    group, slash, own = path.rpartition("/")
    path = FORMER_NAMES.get(group, group) + slash + own
    return FORMER_NAMES.get(path, path)
