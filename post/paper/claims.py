"""The paper's statements, all of them, each decided by one number from the runs."""

from paper import law_claims, pair_claims, speed_claims
from paper.judging import Checked
from paper.runs import Runs

#: In the order of the page.
CLAIMS = (*law_claims.CLAIMS, *pair_claims.CLAIMS, *speed_claims.CLAIMS)


def check(runs: Runs, refined: Runs, rule: Runs) -> list[Checked]:
    """All claims."""
    return [Checked(each, *map(each.judge, (runs, refined, rule))) for each in CLAIMS]
