"""`make site` in a browser: pages, links, anchors, pictures, the search; nothing else is asked for."""

import json
import os
import shutil
import signal
import subprocess
import tempfile
import threading
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from urllib.parse import urlsplit

import pytest
from test_report import BROWSERS

#: Opens every page that links lead to, one after another, and tells what it saw.
PROBE = """<!doctype html><title>probe</title><body><script>
async function opened(address) {
  const frame = document.createElement('iframe');
  frame.width = 1300; frame.height = 900; frame.src = address;
  const loaded = new Promise(done => frame.onload = done);
  document.body.append(frame);
  await loaded;
  return frame;
}
async function until(condition) {
  for (let k = 0; k < 600 && !condition(); k++) await new Promise(done => setTimeout(done, 50));
}
async function visit(address) {
  const frame = await opened(address), page = frame.contentDocument;
  const images = [...page.images].filter(image => image.src);
  images.forEach(image => image.loading = 'eager');
  await Promise.all(images.map(image => image.decode().catch(() => 0)));
  const root = page.documentElement;
  const seen = {title: page.title, ids: [...page.querySelectorAll('[id]')].map(each => each.id),
                links: [...new Set([...page.querySelectorAll('a[href]')].map(each => each.href))],
                images: images.map(image => [image.src, image.naturalWidth]),
                large: page.querySelectorAll('a.glightbox').length,
                text: page.querySelector('article').innerText,
                wide: root.scrollWidth - root.clientWidth};
  frame.remove();
  return seen;
}
async function search(words) {
  const frame = await opened('index.html?q=' + words), page = frame.contentDocument;
  const found = () => [...page.querySelectorAll('.md-search-result__link')].map(each => each.href);
  await until(() => found().length);
  return found();
}
(async () => {
  const pages = {}, files = {}, waiting = [location.origin + '/index.html'];
  while (waiting.length) {
    const address = waiting.pop();
    pages[address] = await visit(address);
    for (const link of pages[address].links) {
      const target = link.split(/[?#]/)[0];
      if (!target.startsWith(location.origin) || target in files) continue;
      files[target] = (await fetch(target, {method: 'HEAD'})).status;
      if (target.endsWith('.html') && !(target in pages)) waiting.push(target);
    }
  }
  const found = {};
  for (const word of ['pivot_ratio', 'LBP', 'gumbel', 'log dec']) found[word] = await search(word);
  const told = {pages: pages, files: files, found: found};
  await fetch('/told', {method: 'POST', body: JSON.stringify(told)});
})();
</script></body>"""


class Site(SimpleHTTPRequestHandler):
    """The site and its probe. As the proxy of the browser it sees every request, and answers its own."""

    def do_GET(self):
        address = urlsplit(self.path)
        if address.netloc not in ("", self.server.host):
            self.refuse()
        elif address.path == "/probe.html":
            self.send_response(200)
            self.send_header("Content-Type", "text/html; charset=utf-8")
            self.end_headers()
            self.wfile.write(PROBE.encode())
        else:
            self.path = address.path
            super().do_GET()

    def do_HEAD(self):
        self.path = urlsplit(self.path).path
        super().do_HEAD()

    def do_POST(self):
        self.server.told = json.loads(self.rfile.read(int(self.headers["Content-Length"])))
        self.send_response(204)
        self.end_headers()
        self.server.done.set()

    def refuse(self):
        self.server.strangers.append(self.path)
        self.send_error(502)

    do_CONNECT = refuse

    def log_message(self, *_):
        pass


@pytest.fixture(scope="module")
def seen(root):
    """What a browser saw of the whole site: `told` by the probe, `strangers` asked for, and `console`."""
    browser = next((path for path in map(shutil.which, BROWSERS) if path), None)
    if browser is None:
        pytest.skip("no Chromium here (Debian: chromium-headless-shell)")
    pages = root / "build/site/pages"
    if not (pages / "index.html").exists():
        pytest.skip("make site has not made it")
    server = ThreadingHTTPServer(("127.0.0.1", 0), lambda *given: Site(*given, directory=str(pages)))
    server.host = f"127.0.0.1:{server.server_port}"
    server.strangers, server.told, server.done = [], None, threading.Event()
    threading.Thread(target=server.serve_forever, daemon=True).start()
    options = [
        "--headless",
        "--no-sandbox",
        "--disable-gpu",
        "--enable-logging=stderr",
        "--remote-debugging-port=0",
    ]
    options += [
        f"--proxy-server={server.host}",
        "--proxy-bypass-list=<-loopback>",
        "--disable-background-networking",
    ]
    with (
        tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder,
        (Path(folder) / "log").open("w+") as log,
    ):
        home = [f"--user-data-dir={folder}/browser", "--window-size=1300,900"]
        # it may be a script that starts the browser, which starts others
        words = [browser, *options, *home, f"http://{server.host}/probe.html"]
        process = subprocess.Popen(words, stderr=log, start_new_session=True)
        server.done.wait(300)
        os.killpg(process.pid, signal.SIGKILL)
        process.wait(60)
        server.shutdown()
        log.seek(0)
        console = [line for line in log if ":CONSOLE" in line]
    assert server.told is not None, console
    return server.told | {"strangers": server.strangers, "console": console}


def test_a_search_finds_an_input_variable_and_the_terms_of_the_trade(seen):
    assert any("docs/inputs.html" in link for link in seen["found"].pop("pivot_ratio"))
    for word, links in seen["found"].items():
        assert any("docs/terms.html" in link for link in links), word
        assert "docs/terms.html" in links[0] or " " in word, links


def test_no_link_is_broken(seen):
    assert {target: status for target, status in seen["files"].items() if status != 200} == {}
    ids = {address: set(page["ids"]) for address, page in seen["pages"].items()}
    for address, page in seen["pages"].items():
        for link in page["links"]:
            target, _, anchor = link.partition("#")
            assert not anchor or target not in ids or anchor in ids[target], (address, link)


def test_every_page_is_there(seen, root):
    shown = {urlsplit(address).path.removeprefix("/") for address in seen["pages"]}
    for file in [root / "README.md", *(root / "docs").rglob("*.md"), *(root / "input").rglob("*.md")]:
        name = file.relative_to(root).with_suffix(".html").as_posix().replace("README.html", "index.html")
        assert name in shown or file.name == "inputs_head.md", name
    assert "docs/notebook.html" in shown


def test_pictures_load_and_open_large(seen):
    for address, page in seen["pages"].items():
        assert [name for name, width in page["images"] if width < 100] == [], address
        assert page["large"] == len(page["images"]), address
    assert sum(len(page["images"]) for page in seen["pages"].values()) > 50


def test_pages_fit_their_window_and_their_markdown_is_read(seen):
    for address, page in seen["pages"].items():
        assert page["wide"] == 0, address
        # a list or a table without an empty line before it would stay text
        marks = [line for line in page["text"].splitlines() if line.startswith(("- ", "| ", "## ", "```"))]
        assert marks == [], address


def test_nothing_is_asked_of_other_hosts_and_the_console_is_empty(seen):
    assert seen["strangers"] == []
    assert seen["console"] == []
