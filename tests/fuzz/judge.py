"""What must hold of every answer of the reader; anything else is a finding."""

import re

from harness import NOT_ITSELF, Case, Reply
from reader import Refused, Unjudged
from reference import Variable
from runs import answered
from runs import expected as runs_of

# longest line of an error, and what is no part of one: control characters of ASCII and Latin-1
LONGEST = 800
CONTROL = re.compile("[\0-\x1f\x7f-\x9f\u2028\u2029]")
# values that do not fit together, which the second reader does not judge
UNFIT = re.compile(rb"case\.nml(, run \d+)?: \w+%\w+ = ")


def findings(case: Case, reply: Reply, variables: dict[str, Variable], words=None) -> list[str]:
    """What is wrong; `words`: the case must be refused with these in the message."""
    if reply.status == NOT_ITSELF:
        return ["the resolved case does not read back to itself"]
    found = [] if reply.status == 0 else line(reply)
    if words is not None:
        if reply.status == 0:
            found.append("a fault is accepted")
        found += [f"the refusal does not name {word!r}" for word in words if word not in reply.text]
    try:
        runs, expected = runs_of(case, variables)
    except Refused as refused:
        if reply.status == 0:
            found.append(f"accepted, but: {refused}")
        return found
    except Unjudged:
        return found
    if reply.status == 0:
        count, cases = answered(reply.text)
        if (count, len(cases)) != (runs, len(expected)):
            return [*found, f"{count} runs, not {runs}"]
        for inputs, values in zip(cases, expected, strict=True):
            found += differences(values, inputs)
    elif not UNFIT.match(reply.text):
        found.append("refused, but the second reader accepts it")
    return found


def line(reply: Reply, places: tuple[str, ...] = ("case.nml", "--set")) -> list[str]:
    """What is wrong with the line of a refusal, which begins with one of the places."""
    found = []
    if reply.status != 1:
        found.append(f"exit status {reply.status}")
    try:
        text = reply.text.decode()
    except UnicodeDecodeError:
        return [*found, "the message is not UTF-8"]
    if CONTROL.search(text):
        found.append("the message has control characters")
    if not text.startswith(places):
        found.append("the message does not say where")
    if len(text) > LONGEST:
        found.append(f"the message is longer than {LONGEST} characters")
    return found


def differences(expected: dict[str, tuple], resolved: dict[str, tuple]) -> list[str]:
    """Variables whose values are not the expected ones to the last bit, where one is expected."""
    return [
        f"{key} is {resolved.get(key)}, not {value}"
        for key, value in expected.items()
        if value is not None and list(map(repr, value)) != list(map(repr, resolved.get(key, ())))
    ]
