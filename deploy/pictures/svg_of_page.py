#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""One drawing of a page of tuner_design (report, study --html) as an SVG file of its own, on white paper.

Usage: svg_of_page.py PAGE.html DRAWING > DRAWING.svg
DRAWING is the id of the drawing's title without "-title". Exit code 1 if the page has no such drawing.
"""

import re
import sys
import xml.etree.ElementTree as ElementTree

SVG = "{http://www.w3.org/2000/svg}"
MARGIN = 10


def style_of(page):
    """The page's rules for drawings, its colours of light paper put in: not every viewer knows variables."""
    style = re.search(r"<style>(.*?)</style>", page, re.S).group(1)
    colours = dict(re.findall(r"--([\w-]+): (#\w+);", style.split("@media")[0]))
    everywhere = re.sub(r"@media[^{]*\{(?:[^{}]*\{[^{}]*\})*\s*\}", "", style)
    rules = [rule.strip() for rule in re.findall(r"[^{}]+\{[^{}]*\}", everywhere)]
    names = "label|axis|heading|tick|value|cell|grid|frame|defect|positive|negative|fill|stroke|thin|dashed|hollow"
    drawn = re.compile(rf"^(svg text|svg \.|\.({names}))")
    kept = [rule for rule in rules if drawn.match(rule)]
    return re.sub(r"var\(--([\w-]+)\)", lambda match: colours[match.group(1)], "\n".join(kept))


def main():
    page = open(sys.argv[1], encoding="utf-8").read()
    root = ElementTree.fromstring(page.replace("<!DOCTYPE html>", "", 1))
    wanted = f"{sys.argv[2]}-title"
    drawings = [svg for svg in root.iter(SVG + "svg") if svg.get("aria-labelledby", "").split()[:1] == [wanted]]
    if not drawings:
        sys.exit(f"svg_of_page: {sys.argv[1]} has no drawing {sys.argv[2]}")
    svg = drawings[0]
    width, height = (float(svg.get(side)) + 2 * MARGIN for side in ("width", "height"))
    svg.set("viewBox", f"{-MARGIN} {-MARGIN} {width:g} {height:g}")
    svg.set("width", f"{width:g}")
    svg.set("height", f"{height:g}")
    svg.set("font-family", "Helvetica, Arial, sans-serif")
    style = ElementTree.Element(SVG + "style")
    style.text = "\n" + style_of(page) + "\n"
    paper = ElementTree.Element(SVG + "rect", {"x": str(-MARGIN), "y": str(-MARGIN), "width": "100%", "height": "100%",
                                               "fill": "#ffffff"})
    svg[2:2] = [style, paper]
    ElementTree.register_namespace("", SVG[1:-1])
    print(ElementTree.tostring(svg, encoding="unicode"))


if __name__ == "__main__":
    main()
