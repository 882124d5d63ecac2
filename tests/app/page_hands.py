"""Hands on a page: tools, settings, buttons and the pointer, each with the picture that follows."""

from page_driver import centre, snapshot, until


def act(page, action):
    """Do something that changes the map or the model, and wait for its picture."""
    before = snapshot(page)["generation"]
    action()
    until(page, "s.generation > argument && s.painted?.generation === s.generation", before)


def choose(page, name):
    more = page.get_by_role("button", name="More tools")
    if more.is_visible():
        more.click()
    page.get_by_role("radio", name=name, exact=True).check()


def press(page, name):
    page.get_by_role("button", name=name, exact=True).click()


def undo(page):
    act(page, lambda: press(page, "Undo"))


def enter(page, name, value):
    field = page.get_by_role("spinbutton", name=name)
    act(page, lambda: field.fill(str(value)) or field.press("Tab"))


def slide(page, name, value):
    act(page, lambda: page.get_by_role("slider", name=name).fill(str(value)))


def run(page, draws=None):
    """Press Run; with a number of draws, wait until there are so many, and their mean is painted."""
    press(page, "Run")
    if draws is not None:
        known = "!s.running && s.draws.count === argument && s.painted.sweeps === argument"
        until(page, f"{known} && s.painted.generation === s.generation", draws)


def show_draw(page, number, chain=None):
    if chain is not None:
        page.get_by_label("Chain", exact=True).select_option(str(chain))
    page.get_by_role("slider", name="Draw number").fill(str(number))
    known = "s.painted.layer === 'draw' && s.painted.draw === argument"
    until(page, known if chain is None else f"{known} && s.painted.chain === {chain}", number)
    return snapshot(page)["probability"]


def click(page, x, y):
    page.mouse.click(*centre(page, x, y))


def press_and_drag(page, cells, steps=1):
    page.mouse.move(*centre(page, *cells[0]))
    page.mouse.down()
    for cell in cells[1:]:
        page.mouse.move(*centre(page, *cell), steps=steps)
    page.mouse.up()


def show_layer(page, name):
    """Choose what is shown, by the keyboard: while figures come in the panel grows, and moves from under a click."""
    page.get_by_role("radio", name=name).press("Space")
