"""The pages of "wrinkle run --report" and "wrinkle watch" in headless Chromium.

    browser.py build/release/wrinkle [SCENE]

With a SCENE it prints how long a number that was saved takes until its picture is on the screen, and tests nothing.
Exit code 77: there is no browser to test in."""
import os
import re
import shutil
import signal
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

try:
    from selenium import webdriver
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys
except ImportError:
    print("skipped: Selenium for Python is missing (Debian's python3-selenium)")
    sys.exit(77)

WRINKLE = Path(sys.argv[1]).resolve()
DATA = Path(__file__).resolve().parents[2] / "data"
DEVICE = ["--device", os.environ["WRINKLE_TEST_DEVICE"]] if os.environ.get("WRINKLE_TEST_DEVICE") else []
LONG = 120  # seconds: kernels are built
HOSTILE = "</script><script>document.title='taken'</script>"
SCENE = f"""# Kept: the first line.
[gbuffer]
file = "{DATA}/gbuffer/small.exr"
[camera]
file = "{DATA}/gbuffer/small.camera.json"

[[layer]]
name = "{HOSTILE}"
kind = "constant"      # kept as well
gradient = [0.3, 0, 0]
[[layer]]
name = "other"
kind = "constant"
gradient = [0, 0, 0.2]
scale = 0.5            # strength
[lighting]
relight = "lit"
[[light]]
kind = "sun"
direction = [0.66, 0.42, -0.62]
"""


def browser():
    chromium, driver = shutil.which("chromium"), shutil.which("chromedriver")
    if not chromium or not driver:
        print("skipped: Chromium is missing (Debian's chromium and chromium-driver)")
        sys.exit(77)
    options = webdriver.ChromeOptions()
    options.binary_location = chromium
    for argument in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                     "--window-size=1200,800"):
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    return webdriver.Chrome(options=options, service=webdriver.chrome.service.Service(driver))


def until(what, condition, seconds=LONG, step=0.02):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        value = condition()
        if value:
            return value
        time.sleep(step)
    raise AssertionError("waited in vain for " + what)


def script(page, text):
    return page.execute_script(text)


def click(page, selector):
    """Finds and clicks in one step: the page makes its layers anew when the file has changed."""
    page.execute_script("document.querySelector(arguments[0]).click()", selector)


def loaded(page):
    return script(page, "const i = document.getElementById('after'); return i.complete && i.naturalWidth")


def pixels(page):
    """The bytes of the picture that is shown after the bumps."""
    return script(page, """const i = document.getElementById('after'), c = document.createElement('canvas');
        [c.width, c.height] = [i.naturalWidth, i.naturalHeight];
        const t = c.getContext('2d');
        t.drawImage(i, 0, 0);
        return Array.from(t.getImageData(0, 0, c.width, c.height).data).join()""")


def shown(page):
    return int(script(page, "return document.body.dataset.shown") or 0)


def complaints(page):
    return [entry for entry in page.get_log("browser") if entry["level"] == "SEVERE"]


def check_slider(page):
    clip = "return document.getElementById('before').style.clipPath"
    before = script(page, clip)
    page.find_element(By.ID, "split").send_keys(Keys.ARROW_RIGHT * 40)
    assert script(page, clip) != before, "the slider moves nothing"


def check_report(page, folder):
    subprocess.run([WRINKLE, "run", "scene.toml", "-o", "out", "--report", "page.html", *DEVICE], cwd=folder,
                   check=True, stdout=subprocess.DEVNULL, timeout=LONG)
    alone = folder / "alone"
    alone.mkdir()
    shutil.move(folder / "page.html", alone)  # it needs nothing beside it
    page.get(f"file://{alone}/page.html")
    until("the report's picture", lambda: loaded(page))
    assert page.title == "scene.toml - wrinkle", page.title
    assert HOSTILE in page.find_element(By.ID, "layers").text
    check_slider(page)
    whole = pixels(page)
    page.find_element(By.CSS_SELECTOR, "[data-view='layer 1']").click()
    until("a layer alone", lambda: pixels(page) != whole)
    for part in ("Time", "Error", "Origin", "kernels"):
        assert part.lower() in page.find_element(By.ID, "tables").text.lower(), part
    assert not complaints(page)


class Watch:
    """The program while it watches a scene."""

    def __init__(self, folder, scene):
        self.process = subprocess.Popen([WRINKLE, "watch", scene, "--no-open", *DEVICE], cwd=folder,
                                        stdout=subprocess.PIPE, text=True)
        self.url = re.search(r"http://\S+", self.process.stdout.readline())[0]

    def end(self):
        self.process.send_signal(signal.SIGINT)
        code = self.process.wait(30)
        assert code == 0, f"Ctrl-C ended it with {code}"


def check_watch(page, folder):
    scene = folder / "scene.toml"
    watch = Watch(folder, "scene.toml")
    try:
        page.get(watch.url)
        until("the first picture", lambda: loaded(page))
        check_slider(page)
        first = pixels(page)

        scene.write_text(SCENE.replace("scale = 0.5", "scale = 0.9"))
        until("the picture of another number", lambda: pixels(page) != first)

        scene.write_text(SCENE.replace("scale = 0.5", "scael = 0.5"))
        problems = page.find_element(By.ID, "problems")
        until("the problem", problems.is_displayed)
        line = SCENE[:SCENE.index("scale = 0.5")].count("\n") + 1
        assert re.search(rf"{line}\s+scael = 0.5.*\n.*did you mean .scale", problems.text), problems.text
        assert loaded(page), "the last good picture is gone"
        scene.write_text(SCENE)
        until("the first picture again", lambda: not problems.is_displayed() and pixels(page) == first)

        slider = page.find_element(By.CSS_SELECTOR, "[data-id='layer.1.scale'] input")
        slider.send_keys(Keys.END)
        until("the picture of a slider", lambda: pixels(page) != first)
        assert scene.read_text() == SCENE, "a slider changed the file by itself"
        until("the button", page.find_element(By.ID, "write").is_enabled)
        click(page, "#write")
        until("the number in the file", lambda: scene.read_text() == SCENE.replace("scale = 0.5 ", "scale = 1.0 "))

        turned = pixels(page)
        click(page, "#layer-1")
        until("a layer that is off", lambda: pixels(page) != turned)
        click(page, "#layers .layer button")  # of the first layer, which is alone already

        ActionChains(page).move_to_element_with_offset(page.find_element(By.ID, "stage"), 40, 30).perform()
        until("numbers of a pixel", lambda: "footprint" in page.find_element(By.ID, "pixel").text)
        assert "gradient of" in page.find_element(By.ID, "pixel").text
        assert page.title == "scene.toml - wrinkle", page.title
        assert not complaints(page)
    finally:
        watch.end()


def measure(page, scene):
    """From the moment that a number is saved until its picture is on the screen."""
    copy = scene.parent / f".watched-{os.getpid()}.toml"  # beside it, for the names in it
    text = scene.read_text()
    copy.write_text(text)
    watch = Watch(copy.parent, copy.name)
    try:
        page.get(watch.url)
        until("the first picture", lambda: loaded(page) and shown(page) > 0)
        seconds = []
        for i in range(20):
            time.sleep(0.3)
            version = shown(page)
            copy.write_text(re.sub(r"(?m)^scale = [\d.]+", f"scale = {0.01 + 0.001 * i}", text, count=1))
            start = time.monotonic()
            until("the picture", lambda: shown(page) > version, step=0.002)
            seconds.append(time.monotonic() - start)
        print(f"saved to shown: median {statistics.median(seconds):.3f} s, "
              f"{min(seconds):.3f} to {max(seconds):.3f} of {len(seconds)}; {script(page, 'return data.status')}")
    finally:
        watch.end()
        copy.unlink()


def main():
    page = browser()
    try:
        if len(sys.argv) > 2:
            return measure(page, Path(sys.argv[2]).resolve())
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            (folder / "scene.toml").write_text(SCENE)
            check_report(page, folder)
            check_watch(page, folder)
    finally:
        page.quit()
    print("ok")


main()
