"""The cases that fuzzing kept, and some seconds of new ones: read as the second reader reads them."""

import os
import sys
from pathlib import Path
from random import Random

import pytest

ROOT = Path(__file__).resolve().parent.parent.parent
HARNESS = Path(os.environ.get("FUZZ_INPUT", ROOT / "build/debug/fuzz/fuzz_input"))
SECONDS = 10

sys.path.insert(0, str(ROOT / "tests/fuzz"))

import commands  # noqa: E402
import seeds  # noqa: E402
from campaign import Campaign  # noqa: E402
from harness import Case, Crash, Hang, Harness  # noqa: E402

KEPT = ROOT / "tests/fuzz/seeds.jsonl"


@pytest.fixture(scope="module")
def campaign():
    assert HARNESS.exists(), "make MODE=debug build/debug/fuzz/fuzz_input"
    with Harness(HARNESS) as harness:
        yield Campaign(harness, seed=1)


def test_kept_cases(campaign):
    cases = seeds.load(KEPT)
    assert cases
    for case, why in cases:
        wrong, _ = campaign.judged(case)
        assert not wrong, (case, why)
    campaign.corpus += [case for case, _ in cases]


def test_new_cases(campaign):
    campaign.run(SECONDS)
    assert campaign.count.total() > 100
    assert not campaign.found, list(campaign.found.values())


def test_commands(campaign, program):
    """The program itself with arguments of any bytes; runs at the limits are left to make fuzz."""
    for number in range(60):
        dice = Random(number)
        kind = dice.choice(
            (commands.set_arguments, commands.output_name, commands.case_name, commands.options)
        )
        words, wrong = commands.in_folder(dice, kind, program, campaign.variables, campaign.corpus)
        assert not wrong, words


def fake(folder, words):
    """A harness that answers its first request, then does what the shell words say."""
    path = folder / "fake"
    path.write_text(f"#!/bin/sh\n{words}\n")
    path.chmod(0o755)
    return path


def test_a_crash_belongs_to_its_case(tmp_path):
    with Harness(fake(tmp_path, "echo broken >&2; kill -SEGV $$")) as harness:
        for _ in range(2):
            with pytest.raises(Crash, match="broken"):
                harness.read(Case(b"&case /"))


def test_a_hang_belongs_to_its_case(tmp_path):
    with Harness(fake(tmp_path, "exec sleep 60"), limit=0.2) as harness, pytest.raises(Hang):
        harness.read(Case(b"&case /"))


# cases read wrongly in some way must be seen: the text given to the reader, the text judged
@pytest.mark.parametrize(
    ("read", "judged", "what"),
    [
        ("&rotor mass=1 /", "&rotor mass=2 /", "rotor%mass is"),
        ("&rotor unbalance=0 /", "&rotor unbalance=-0.0 /", "rotor%unbalance is"),
        ("&rotor mass=1 /", "&rotor mass=1 mass=2 /", "accepted, but"),
        ("&rotor mass=x /", "&rotor mass=1 /", "second reader accepts"),
    ],
)
def test_a_wrong_answer_is_seen(campaign, read, judged, what):
    from judge import findings

    reply = campaign.harness.read(Case(read.encode()))
    assert any(what in each for each in findings(Case(judged.encode()), reply, campaign.variables))
