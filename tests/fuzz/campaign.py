"""Cases drawn, read and judged, as many as the time allows; what is found is made small."""

import re
import time
from collections import Counter
from dataclasses import dataclass, field
from random import Random

import cases
import faults
import machines
import mutate
import spelling
import studies
import tables
from harness import Case, Crash, Hang, Harness, Reply
from judge import findings, line
from reference import Variable, variables

# longest case that others are made from
LONGEST_KEPT = 2000


@dataclass
class Finding:
    """What is wrong with a case, as small as it goes, and what the reader said to it."""

    case: Case
    what: str
    said: str


@dataclass
class Campaign:
    """The reader under test, the cases that reached something new, what was found."""

    harness: Harness
    seed: int = 1
    corpus: list[Case] = field(default_factory=list)
    found: dict[str, Finding] = field(default_factory=dict)
    count: Counter = field(default_factory=Counter)

    def __post_init__(self) -> None:
        self.variables: dict[str, Variable] = variables(self.harness.reference())

    def run(self, seconds: float, most: int = 10**9) -> None:
        """Draws cases for this many seconds, or at most this many cases."""
        end = time.monotonic() + seconds
        while time.monotonic() < end and most > 0:
            self.one(Random(f"{self.seed}/{self.count.total()}"))
            most -= 1

    def one(self, dice: Random) -> None:
        """One case of any kind."""
        kind = dice.random()
        if kind < 0.05:
            self.one_table(dice)
            return
        if self.corpus and kind < 0.6:
            self.check(mutate.mutated(dice, self.corpus), "changed", back=dice.random() < 0.2)
            return
        if kind < 0.65:
            self.check(machines.draw(dice), "valid machine", intended=0)
            return
        inputs = cases.draw(dice, self.variables)
        if kind < 0.8:
            fault = faults.plant(dice, inputs, self.variables)
            self.check(fault.case, f"fault: {fault.kind}", fault.words)
        elif kind < 0.95:
            self.check(spelling.case(dice, inputs, self.variables), "valid", intended=0)
        else:
            study, count = studies.draw(dice, self.variables)
            varied = {item.key.removeprefix("sweep%") for item in study.items}
            inputs = {key: value for key, value in inputs.items() if key not in varied}
            self.check(spelling.case(dice, inputs, self.variables, study), "valid study", intended=count)

    def one_table(self, dice: Random) -> None:
        """One table, right or changed."""
        valid = dice.random() < 0.3
        case = tables.draw(dice, self.variables)
        case = case if valid else tables.changed(dice, case)
        self.count["valid table" if valid else "changed table"] += 1
        try:
            reply = self.harness.table(case)
        except (Crash, Hang) as error:
            wrong, said = [f"{type(error).__name__.lower()}: {error}"], ""
        else:
            wrong = [] if reply.status == 0 else line(reply, ("members.csv",))
            wrong += tables.findings(case, reply, self.variables, valid)
            said = f"{reply.status}: {reply.text[:300].decode(errors='replace')}"
        for what in wrong:
            sort = f"table: {sort_of(what)}"
            if sort not in self.found:
                self.found[sort] = Finding(case, f"table: {what}", said)
                print(f"FOUND: table: {what[:2000]}\n   {case!r:.1500}\n   {said}", flush=True)

    def check(self, case: Case, kind: str, words=None, intended=None, back: bool = True) -> None:
        """Reads and judges a case."""
        self.count[kind] += 1
        wrong, reply = self.judged(case, words, intended, back)
        if reply and reply.news and len(case.text) <= LONGEST_KEPT:
            self.corpus.append(case)
        for what in wrong:
            self.note(case, what, kind, words)

    def judged(
        self, case: Case, words=None, intended=None, back: bool = True
    ) -> tuple[list[str], Reply | None]:
        """What is wrong, and the answer if there was one."""
        try:
            reply = self.harness.read(case, back)
        except Crash as crash:
            return [f"crash: {crash}"], None
        except Hang as hang:
            return [f"hang: {hang}"], None
        wrong = findings(case, reply, self.variables, words)
        if intended is not None and reply.status != 0:
            wrong.append("a valid case is refused")
        if intended and reply.text.partition(b"\0")[0] != b"%d" % intended:
            wrong.append(f"not {intended} runs")
        return wrong, reply

    def note(self, case: Case, what: str, kind: str, words) -> None:
        """Keeps a finding of a new kind, made small."""
        sort = sort_of(what)
        if sort in self.found:
            self.count["found again"] += 1
            return
        # what a planted fault or a valid case must do does not hold for parts of it
        part = not words and not kind.startswith("valid")

        def same(smaller: Case) -> bool:
            return sort in map(sort_of, self.judged(smaller)[0])

        small = mutate.shrunk(case, same) if part or same(case) else case
        wrong, reply = self.judged(small)
        said = f"{reply.status}: {reply.text[:300].decode(errors='replace')}" if reply else ""
        self.found[sort] = Finding(small, f"{kind}: {what}", said)
        print(f"FOUND: {kind}: {what[:2000]}\n   {small!r:.1500}\n   {said}", flush=True)


def sort_of(what: str) -> str:
    """A finding without what differs from case to case; of a crash the place alone."""
    place = re.search(r"(\w+\.f90):\d+|At line \d+ of file \S+|ERROR: \w+: [\w-]+", what)
    if what.startswith("crash") and place:
        return f"crash {place[0]}"
    what = re.sub(r"b'.*'|b\".*\"", "..", what)
    return re.sub(r"[-+.e\d]*\d", "0", what)[:60]
