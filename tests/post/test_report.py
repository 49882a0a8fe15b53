"""tiltpad-report: the content of the page, and that a browser shows it."""

import json
import re
import shutil
import subprocess
from html.parser import HTMLParser
from urllib.parse import unquote

import numpy as np
import pytest
import tiltpad
from tiltpad import command, summary
from tiltpad.calculate import vibration_limits
from tiltpad.draw import layout

pytestmark = pytest.mark.usefixtures("quick_pictures")

#: Cases whose page a browser shows; the pictures of the others are made, but not written.
SHOWN = ("lugre", "runup", "equilibrium")
BROWSERS = ("chromium-headless-shell", "chromium", "chromium-browser", "google-chrome")
#: Run by the browser in a copy of the page: what it made of it.
PROBE = """<pre id=probe></pre><script>addEventListener('load', () => {
  const short = document.body.innerText;
  document.querySelectorAll('details').forEach(each => each.open = true);
  const images = [...document.images].map(i => [i.alt, i.complete, i.naturalWidth, i.naturalHeight, i.width]);
  const page = document.documentElement;
  const found = {title: document.title, short: short, text: document.body.innerText, images: images,
                 wide: page.scrollWidth - page.clientWidth};
  const told = encodeURIComponent(JSON.stringify(found));
  document.getElementById('probe').textContent = 'PROBE' + told + 'PROBE';
});</script>"""


@pytest.fixture(scope="module")
def page(result, tmp_path_factory):
    """page("lugre"): text of the report about that case's result."""
    folder = tmp_path_factory.mktemp("pages")

    def text(case_name):
        output = folder / f"{case_name}.html"
        if not output.exists():
            with pytest.MonkeyPatch.context() as patch:
                if case_name not in SHOWN:
                    patch.setattr(layout, "write", lambda figure, stream, *_, **more: stream.write(b"<svg/>"))
                assert command.report([str(result(case_name)), "-o", str(output)]) == 0
        return output.read_text(encoding="utf-8")

    return text


class Outline(HTMLParser):
    """Headings, pictures and the tables' rows; every element that is opened is closed."""

    def __init__(self, text):
        super().__init__()
        self.open, self.headings, self.images, self.rows, self.sources = [], [], [], {}, []
        #: The rows of the first table, which the page begins with.
        self.facts = {}
        self.feed(text)
        assert self.open == []

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        self.sources += [attributes[name] for name in ("src", "href") if name in attributes]
        if tag == "img":
            self.images.append(attributes["alt"])
        if tag not in ("img", "meta"):
            self.open.append(tag)
        if tag == "tr":
            self.row = []

    def handle_endtag(self, tag):
        assert self.open.pop() == tag
        if tag == "tr":
            self.rows[self.row[0]] = self.row[1:]
            if "Key figures" not in self.headings:
                self.facts[self.row[0]] = self.row[1:]

    def handle_data(self, data):
        if self.open[-1:] in (["h1"], ["h2"]):
            self.headings.append(data)
        if self.open[-1:] in (["td"], ["th"]):
            self.row.append(data)


STEADY = ["orbit", "waveform", "spectrum", "runup", "poincare"]
FRICTION = ["hysteresis", "friction", "sticking"]


@pytest.mark.parametrize(
    ("case_name", "pictures"),
    [
        ("lugre", STEADY + FRICTION),
        ("none", STEADY),
        ("fixed", STEADY),
        ("tilting", STEADY + FRICTION),
        ("four", STEADY + FRICTION),
        ("runup", ["orbit", "waveform", "runup", "size", "poincare", *FRICTION]),
        ("equilibrium", ["equilibrium"]),
        ("periodic", [*STEADY, *FRICTION, "multipliers"]),
    ],
)
def test_the_page_has_what_the_run_has(page, case_name, pictures):
    text = page(case_name)
    outline = Outline(text)
    assert sorted(outline.images) == sorted([*pictures, "bearing", "film", "pressure"])
    assert all(source.startswith("data:image/svg+xml;base64,") for source in outline.sources)
    assert "<script" not in text
    assert "url(" not in text
    assert outline.headings[0] == ("Steady, it's LuGre" if case_name == "lugre" else case_name)
    assert ("Spectrum" in outline.headings) == (case_name not in ("runup", "equilibrium"))
    assert ("friction work a revolution" in outline.rows) == ("friction" in pictures)
    assert "equilibrium: journal displacement, vertical" in outline.rows


def test_a_periodic_orbit_is_said_to_be_stable(page, run):
    text = page("periodic")
    rows = Outline(text).rows
    assert "The periodic orbit is stable" in text
    assert rows["period of the orbit"] == ["9.231", "ms"]
    leading = run("periodic")["periodic/multiplier_real"][0]
    assert float(rows["leading multiplier, real part"][0]) == pytest.approx(leading, rel=1e-3)


def test_its_numbers_are_those_of_the_run(page, run):
    rows, case = Outline(page("lugre")).rows, run("lugre")
    y, z = tiltpad.orbit_size(case)
    assert rows["orbit, peak to peak of y"] == [f"{1e6 * y:.4g}", "µm"]
    assert rows["orbit, peak to peak of z"] == [f"{1e6 * z:.4g}", "µm"]
    work = [f"{1e3 * tiltpad.friction_work(case, pad):.4g}" for pad in (1, 2)]
    assert rows["friction work a revolution"] == [*work, "mJ"]
    share = [f"{100 * tiltpad.stick_fraction(case, pad):.4g}" for pad in (1, 2)]
    assert [float(each) for each in rows["share of time that the pivot sticks"][:2]] == [
        float(each) for each in share
    ]
    assert float(rows["minimum film thickness of the whole run"][0]) == pytest.approx(
        1e6 * case.min_film_thickness.min(), rel=1e-3
    )
    assert float(rows["maximum pressure, last revolution or period"][0]) == pytest.approx(
        1e-6 * case.max_pressure[-361:].max(), rel=1e-3
    )
    assert rows["time steps"][0] == str(case["statistics/steps"])
    assert "bristle_stiffness = 1e6" in page("lugre")


def test_peaks_of_a_spectrum(changed, opened):
    """Those of the spectrum in the file, above a thousandth of the highest."""

    def edit(file):
        order = file["spectrum/order"][()]
        for name, peaks in (("journal_y", {1: 1e-6, 0.5: 3e-7}), ("journal_z", {1: 2e-6, 5: 1e-10})):
            own = np.zeros(len(order))
            for each, amplitude in peaks.items():
                own[np.argmin(np.abs(order - each))] = amplitude
            file[f"spectrum/{name}"][...] = own

    first, second = summary.peaks(opened(changed("lugre", edit)))
    assert first == pytest.approx((1, 6500 / 60, 1e-6, 2e-6), rel=1e-6)
    assert second == pytest.approx((0.5, 6500 / 120, 3e-7, 0), rel=1e-6)


def shorten(file, samples=700):
    """Makes a result one that ended after a number of samples."""
    file.attrs["complete"] = 0
    del file["spectrum"]
    for name in [name for name, each in file.items() if getattr(each, "maxshape", ())[:1] == (None,)]:
        file[name].resize(samples, axis=0)


def test_a_run_that_ended_early(changed, tmp_path, capsys):
    output = tmp_path / "a.html"
    assert command.report([str(changed("lugre", shorten)), "-o", str(output)]) == 0
    assert capsys.readouterr().err.count("\n") == 1
    text = output.read_text()
    assert "Incomplete run, ended at 0.0179231 s of 0.06 s." in text
    assert sorted(Outline(text).images) == sorted([*STEADY, *FRICTION, "bearing", "film", "pressure"])


def test_a_run_that_ended_at_once(changed, tmp_path):
    output = tmp_path / "a.html"
    assert command.report([str(changed("lugre", lambda file: shorten(file, 0))), "-o", str(output)]) == 0
    assert Outline(output.read_text()).images == ["bearing", "equilibrium", "pressure", "film"]
    assert "Incomplete run without samples in time." in output.read_text()


def test_errors_are_one_line_and_a_status(result, tmp_path, capsys):
    for arguments, status, message in (
        (["missing.h5"], 3, "missing.h5: no such file"),
        ([str(result("none")), "-o", "a.pdf"], 1, "a.pdf: the name must end in .html or .htm"),
        ([str(result("none")), "-o", str(tmp_path / "no/a.html")], 3, "cannot be written: No such file"),
    ):
        assert command.report(arguments) == status
        said = capsys.readouterr().err
        assert said.startswith("tiltpad-report: error: ")
        assert message in said
        assert said.count("\n") == 1


@pytest.mark.parametrize("case_name", SHOWN)
def test_a_browser_shows_it(page, run, tmp_path, case_name):
    browser = next((path for path in map(shutil.which, BROWSERS) if path), None)
    if browser is None:
        pytest.skip("no Chromium here (Debian: chromium-headless-shell)")
    copy = tmp_path / "probed.html"
    copy.write_text(page(case_name).replace("</body>", PROBE + "</body>"), encoding="utf-8")
    options = ["--headless", "--no-sandbox", "--disable-gpu", "--virtual-time-budget=5000", "--dump-dom"]
    home = ["--window-size=500,1200", f"--user-data-dir={tmp_path / 'browser'}"]
    done = subprocess.run(
        [browser, *options, *home, copy.as_uri()], capture_output=True, text=True, timeout=300, check=True
    )
    found = json.loads(unquote(re.search("<pre id=.probe.>PROBE(.*?)PROBE", done.stdout)[1]))
    assert found["title"] == ("Steady, it's LuGre" if case_name == "lugre" else case_name)
    assert found["wide"] == 0
    assert len(found["images"]) == len(Outline(page(case_name)).images)
    for name, complete, width, height, shown in found["images"]:
        assert complete, name
        assert min(width, height, shown) > 100, name
    assert "minimum film thickness" in found["short"]
    assert "samples_per_revolution" not in found["short"]
    for text in (
        "Key figures",
        "equilibrium: journal displacement, vertical",
        "Input",
        "samples_per_revolution = 360",
    ):
        assert text in found["text"]
    if case_name != "equilibrium":
        assert f"{1e6 * tiltpad.orbit_size(run(case_name))[0]:.4g}\tµm" in found["text"]


def test_the_page_begins_with_stability_loads_films_and_losses(page, run):
    first = page("offset")[: page("offset").index("<details>")]
    case = run("offset")
    found = tiltpad.modes(case)
    journal = np.char.startswith(found.name, "journal") & (found.frequency > 0)
    decrement = found.log_decrement[journal].min()
    assert f"The journal is stable with pivots free: least logarithmic decrement {decrement:.3g}" in first
    rows = Outline(page("offset")).facts
    load = np.hypot(1200 * 9.81, 4000)
    assert rows["load"][:2] == [f"{1e-3 * load:.2f}", "kN"]
    film = case.equilibrium["min_film_thickness"]
    assert rows["minimum film thickness"] == [f"{1e6 * film.min():.2f}", "µm", f"pad {film.argmin() + 1}"]
    assert float(rows["power loss"][0]) == pytest.approx(
        1e-3 * case["equilibrium/total_power_loss"], rel=1e-3
    )
    k = tiltpad.coefficients(case).stiffness[0]
    assert float(rows["stiffness K yy"][0]) == pytest.approx(1e-6 * k[0, 0], rel=1e-3)


def test_a_vibration_is_told_against_the_limits_of_standards(page, run):
    first = page("none")[: page("none").index("<details>")]
    size = run("none")["summary/orbit_size"]
    assert f"API 617 allows 25.40 µm ({'kept' if size <= 25.4e-6 else 'exceeded'})" in first
    # above 12000 rpm as the root of the speed; zones end at 4800, 9000 and 13200 over that of the speed
    assert vibration_limits.of_api_617(48000) == pytest.approx(12.7e-6)
    assert vibration_limits.of_api_617(3000) == pytest.approx(25.4e-6)
    sizes = [47e-6, 49e-6, 89e-6, 91e-6, 131e-6, 133e-6]
    assert [vibration_limits.zone(each, 10000) for each in sizes] == list("ABBCCD")


def test_remarks_stand_in_the_order_of_their_weight(changed, tmp_path):
    told = [
        "surface speed 1 m/s at 200 rpm: seldom so low",
        "at the equilibrium pad 3 carries no load; unloaded pads may flutter",
        "pad 4 flutters at 0.475 of the shaft speed, amplitude of the tilt 2.6 mrad",
        "pad 3 carries next to no load (mean 17.8 N); it rubs on the journal 0.4 % of the time",
        "the journal whirls at 0.494 of the shaft speed, amplitude 91.777 um",
        "Reynolds number of the film of pad 3: 557; above 500 films may be turbulent",
        "the oil warms by 60.0 K although every pad draws fresh oil",
    ]

    def edit(file):
        file["summary"].pop("remarks", None)
        file.create_dataset("summary/remarks", data=np.array(told, dtype="S")).make_scale("summary/remarks")

    path = tmp_path / "a.html"
    assert command.report([str(changed("none", edit)), "-o", str(path)]) == 0
    text = path.read_text()
    places = [text.index(f"{told[k][0].upper()}{told[k][1:]}.") for k in (3, 4, 2, 1, 6, 0, 5)]
    assert places == sorted(places)
    # the heaviest on the first screen
    assert places[4] < text.index("<h2>Further remarks</h2>") < places[5]
