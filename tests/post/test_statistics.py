"""Statistics of sampled studies: percentiles, shares and causes, Sobol indices against closed forms."""

import builtins
import itertools

import numpy as np
import pytest
import tiltpad
from sampled import write_study
from scipy import stats
from scipy.stats import qmc
from tiltpad import sampling
from tiltpad.calculate import expansion, sensitivity, statistics

#: The Ishigami function's indices: of first order, and total.
MAIN = np.array([0.5 * (1 + 0.1 * np.pi**4 / 5) ** 2, 7**2 / 8, 0])
BOTH = 0.1**2 * np.pi**8 * (1 / 18 - 1 / 50)
FIRST = MAIN / (MAIN.sum() + BOTH)
TOTAL = FIRST + np.array([BOTH, 0, BOTH]) / (MAIN.sum() + BOTH)


def ishigami(points):
    """Its values at points of the unit cube, (point, dimension)."""
    x = 2 * np.pi * points.T - np.pi
    return np.sin(x[0]) + 7 * np.sin(x[1]) ** 2 + 0.1 * x[2] ** 4 * np.sin(x[0])


@pytest.fixture
def study(tmp_path):
    """study({"clearance": ...}, {"least_damping_ratio": ...}, status, reason): that study, opened."""
    numbers, opened = itertools.count(), []

    def make(*arguments, **options):
        path = write_study(tmp_path / f"study{next(numbers)}.h5", *arguments, **options)
        opened.append(tiltpad.read_study(path))
        return opened[-1]

    yield make
    for each in opened:
        each.close()


def named(points):
    """Columns of inputs x1, x2, ..."""
    return {f"x{k}": column for k, column in enumerate(np.transpose(points), 1)}


def test_percentiles_are_those_of_numpy(study):
    values = np.random.default_rng(1).normal(0.2, 0.05, (101, 3))
    values[7] = np.nan
    status = np.zeros(101, dtype=int)
    status[7] = 2
    made = study({"clearance": np.arange(101.0)}, {"least_damping_ratio": values}, status)
    found = tiltpad.percentiles(made)
    known = np.delete(values[:, 0], 7)
    assert (found.results, list(found.runs)) == (["least_damping_ratio"], [100])
    np.testing.assert_allclose(found.values[0], np.percentile(known, [5, 25, 50, 75, 95]), rtol=1e-14)
    np.testing.assert_allclose([found.mean[0], found.deviation[0]], [known.mean(), known.std(ddof=1)])
    stuck = tiltpad.percentiles(made, "least_damping_ratio", pivot="stuck")
    assert stuck.values[0, 2] == np.median(np.delete(values[:, 1], 7))
    with pytest.raises(ValueError, match="is not a parameter of this study"):
        tiltpad.percentiles(made, where={"speed_rpm": 1})


def test_a_threshold_that_is_not_reached_is_higher(study):
    """Of 21 runs 16 have one up to 12000 rpm: the 75 % percentile is the highest of these."""
    threshold = np.full((21, 3), np.nan)
    threshold[:16, 0] = np.arange(16) * 100 + 8000
    results = {"threshold_rpm": threshold, "threshold_sought_rpm": np.full(21, 12000.0)}
    found = tiltpad.percentiles(study({"clearance": np.arange(21.0)}, results), "threshold_rpm")
    assert list(found.values[0]) == [8100, 8500, 9000, 9500, np.inf]
    assert found.runs[0] == 21
    assert np.isnan(found.mean[0])


def test_percentiles_of_one_run_and_of_none(study):
    one = tiltpad.percentiles(study({"clearance": np.ones(1)}, {"a": np.ones(1)}), "a")
    assert (one.mean[0], list(one.values[0])) == (1, [1] * 5)
    assert np.isnan(one.deviation[0])
    none = tiltpad.percentiles(study({"clearance": np.ones(3)}, {"a": np.full(3, np.nan)}), "a")
    assert none.runs[0] == 0
    assert np.isnan(none.values).all()
    assert tiltpad.percentiles(study({"clearance": np.ones(3)}, {"a": np.ones(3)})).results == []


@pytest.mark.parametrize(
    ("count", "of"), [(0, 10), (1, 10), (5, 10), (10, 10), (3, 1000), (999, 1000), (1, 1)]
)
def test_the_interval_of_a_share_is_wilson_s(count, of):
    expected = stats.binomtest(count, of).proportion_ci(method="wilson")
    found = statistics.share(count, of)
    np.testing.assert_allclose((found.low, found.high), expected, atol=1e-12)
    assert found.share == count / of
    assert statistics.share(0, 0)[3:] == (0, 1)


def test_outcomes_and_their_causes(study):
    """Messages that differ in numbers and names are one cause; what has not ended is not refused."""
    reasons = {
        2: "no equilibrium found at 9000 rpm: pad 1 has no equilibrium (unloaded)",
        3: "no equilibrium found at 9100.5 rpm: pad 3 has no equilibrium (unloaded)",
        5: "film of pad 2 closed at 1.2e-3 s",
        6: "stopped by signal 15",
        8: "out/0009.h5: not an HDF5 file",
    }
    status = np.array([0, 0, 2, 2, 0, 2, 4, -2, np.nan, 0, -1])
    damping = np.where(status == 0, 0.1, np.nan)[:, None] * np.ones(3)
    damping[1, 0], damping[4, 2] = -0.01, -0.2
    stable = np.where(status == 0, 1.0, np.nan)
    stable[9] = 0
    results = {"least_damping_ratio": damping, "equilibrium_stable": stable}
    texts = [reasons.get(k, "") for k in range(11)]
    made = study({"clearance": np.arange(11.0)}, results, status, texts)
    found = tiltpad.outcomes(made)
    assert (found.runs, found.unfinished, found.done) == (11, 3, 4)
    assert found.refused[:3] == (4, 8, 0.5)
    assert {text: each.runs for text, each in found.causes.items()} == {
        "no equilibrium found at # rpm: pad # has no equilibrium (unloaded)": 2,
        "film of pad # closed at # s": 1,
        "...: not an HDF5 file": 1,
    }
    assert found.unstable[:2] == (2, 4)
    assert tiltpad.outcomes(made, "locked").unstable[:2] == (2, 4)
    assert tiltpad.outcomes(made, "stuck").unstable[:2] == (1, 4)
    # of pads alone where the study tells the rotor's
    apart = {"rotor_damping_ratio": np.abs(damping), "equilibrium_rotor_stable": np.abs(stable) ** 0}
    told = study({"clearance": np.arange(11.0)}, results | apart, status, texts)
    assert tiltpad.outcomes(told, "locked").unstable[:2] == (0, 4)
    assert tiltpad.outcomes(study({"a": np.arange(3.0)}, {})).unstable is None
    assert tiltpad.outcomes(made, where={"clearance": 2}).refused[:2] == (1, 1)


def indices(points, values):
    """Indices of a regression, as Sensitivity has them."""
    columns = list(np.transpose(points))
    return sensitivity.regression(expansion.expansion(columns, values), columns, values)


@pytest.mark.parametrize("dimensions", [3, 7])
def test_indices_of_the_ishigami_function_converge(dimensions):
    """To those known, within their 95 % intervals, and with further inputs that do nothing."""
    first, total = (np.append(each, np.zeros(dimensions - 3)) for each in (FIRST, TOTAL))
    errors, inside = [], []
    for runs in (256, 1024):
        for seed in range(4):
            points = qmc.Sobol(dimensions, rng=seed).random(runs)
            found = indices(points, ishigami(points))
            inside += list((found[1] <= first) & (first <= found[2]))
            inside += list((found[4] <= total) & (total <= found[5]))
            errors.append(np.abs(found[0] - first).max())
    worst = np.max(np.reshape(errors, (2, 4)), axis=1)
    assert np.mean(inside) > 0.9
    assert worst[1] < 0.03
    assert worst[1] < worst[0]


@pytest.mark.parametrize("runs", [64, 256, 1024])
def test_indices_of_a_linear_function(runs):
    """Errors are those of the variances of so few random inputs, 2 S (1 - S) sqrt(2/n): four of them."""
    weights = np.array([4, 3, 2, 1, 0.5, 0])
    known = weights**2 / (weights**2).sum()
    for seed in range(5):
        points = stats.norm.ppf(np.random.default_rng(seed).random((runs, 6)))
        found = indices(points, points @ weights)
        assert (np.abs(found[0] - known) < 8 * known * (1 - known) * np.sqrt(2 / runs) + 1e-6).all()
        np.testing.assert_allclose(found[0], found[3], atol=1e-9)


def test_indices_of_a_step_which_no_polynomial_follows():
    """Bins have what the polynomials leave; the known indices are those of conditional means."""
    u = (np.arange(10000) + 0.5) / 10000
    of_first, of_second = np.clip(2 * u - 0.8, 0, 1), np.clip(0.1 + u / 2, 0, 1)
    share = of_first.mean()
    known = np.array([of_first.var(), of_second.var(), 0]) / (share * (1 - share))
    points = qmc.Sobol(3, rng=1).random(1024)
    values = (points[:, 0] + points[:, 1] / 2 > 0.9).astype(float)
    found = indices(points, values)
    assert ((found[1] <= known) & (known <= found[2])).all()
    np.testing.assert_allclose(found[0], known, atol=0.03)


def test_a_saltelli_design_has_the_estimators_of_scipy(study):
    points = sampling.points(3, 256, "saltelli", 1).T
    values = ishigami(points)
    found = tiltpad.sensitivity(study(named(points), {"result": values}), "result")
    table = values.reshape(256, 5)
    of = {"f_A": table[None, :, 0], "f_B": table[None, :, 1], "f_AB": table[:, 2:].T[:, None, :]}
    expected = stats.sobol_indices(func=of, n=256)
    assert (found.method, found.runs, found.inputs) == ("saltelli", 1280, ["x1", "x2", "x3"])
    np.testing.assert_allclose(found.first, np.clip(expected.first_order, 0, 1), atol=1e-12)
    np.testing.assert_allclose(found.total, np.clip(expected.total_order, 0, 1), atol=1e-12)
    for low, known, high in (
        (found.first_low, FIRST, found.first_high),
        (found.total_low, TOTAL, found.total_high),
    ):
        assert ((low <= known + 1e-9) & (known <= high + 1e-9)).all()
    # a refused run takes its point out, and what is not whole at the end is left out
    status = np.zeros(1280, dtype=int)
    status[7], status[1270:] = 2, -2
    less = tiltpad.sensitivity(study(named(points), {"result": values}, status), "result")
    assert (less.method, less.runs) == ("saltelli", 1280 - 5 - 10)
    np.testing.assert_allclose(less.first, found.first, atol=0.02)


def test_signs_and_means_of_a_sample(study):
    points = qmc.Sobol(3, rng=2).random(512)
    values = 1 - 3 * points[:, 0] + points[:, 1]
    found = tiltpad.sensitivity(study(named(points), {"result": values}), "result")
    np.testing.assert_allclose(found.rank[:2], stats.spearmanr(points[:, :2], values).statistic[2, :2])
    # the lowest and the highest tenth of 0 to 1 are 0.05 and 0.95 on average
    np.testing.assert_allclose(found.low, [0 + 1.35, 0 - 0.45, 0], atol=5e-3)
    np.testing.assert_allclose(found.high, [0 - 1.35, 0 + 0.45, 0], atol=5e-3)
    assert (found.method, found.runs) == ("regression", 512)
    assert found.explained > 1 - 1e-9


def test_texts_are_inputs(study):
    """A text with the means -1, 0 and 1 has the variance 2/3, a number over 0 to 1 1/12."""
    texts = np.array(["a", "b", "c"] * 200, dtype=object)
    number = np.random.default_rng(3).random(600)
    values = np.array([-1, 0, 1] * 200) + number
    found = tiltpad.sensitivity(study({"law": texts, "x": number}, {"result": values}), "result")
    known = np.array([2 / 3, 1 / 12]) / 0.75
    np.testing.assert_allclose(found.first, known, atol=0.02)
    assert np.isnan(found.rank[0])
    np.testing.assert_allclose([found.low[0], found.high[0]], [-0.5, 1.5], atol=0.06)


def test_what_cannot_be_calculated_is_said(study):
    points = np.random.default_rng(1).random((64, 2))
    x = named(points)
    nan, refused = np.full(64, np.nan), np.full(64, 2)
    sum_of = {"result": points.sum(axis=1)}
    for parameters, results, status, words in (
        (x, {"result": np.full(64, 3.0)}, None, "result is the same in all runs"),
        (x, {"result": nan}, None, "indices need 16 runs that have a value, here are 0"),
        (x, sum_of, refused, "indices need 16 runs that have a value, here are 0"),
        (x, sum_of, np.full(64, -2), "indices need 16 runs that have a value, here are 0"),
        ({"x": np.ones(64)}, sum_of, None, "its runs differ in no parameter"),
        ({"x1": points[:, 0], "x2": points[:, 0] ** 2}, sum_of, None, "x1 and x2 vary together"),
        (x, {}, None, "result is not a result of this study"),
        (named(points[:1]), {"result": np.ones(1)}, None, "its runs differ in no parameter"),
    ):
        with pytest.raises(ValueError, match=words) as error:
            tiltpad.sensitivity(study(parameters, results, status), "result")
        assert "\n" not in f"{error.value}"
    some = np.where(np.arange(64) < 20, points.sum(axis=1), np.nan)
    assert tiltpad.sensitivity(study(x, {"result": some}), "result").runs == 20


def test_statistics_need_no_scipy(study, monkeypatch):
    points = qmc.Sobol(2, rng=1).random(64)
    made = study(named(points), {"least_damping_ratio": points[:, :1] * np.ones(3)})
    imported = builtins.__import__

    def without(name, *arguments, **options):
        if name.partition(".")[0] == "scipy":
            raise ImportError(name)
        return imported(name, *arguments, **options)

    monkeypatch.setattr(builtins, "__import__", without)
    assert tiltpad.sensitivity(made, "least_damping_ratio").first[0] > 0.99
    assert tiltpad.outcomes(made).unstable.runs == 0
    assert tiltpad.percentiles(made).runs[0] == 64
