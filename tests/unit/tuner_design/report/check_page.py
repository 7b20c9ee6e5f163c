#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks one report page as a browser, a screen reader and a firewall would.

Usage: check_page.py PAGE.html CSV_FOLDER
It is well-formed XML, has unique ids, fetches nothing, runs nothing; every drawing has a title and a description, every
table a caption, every figure its numbers; the numbers in the page are those in the folder, byte by byte.
Prints one line for each defect; exit code 1 if there is any.
"""

import os
import re
import sys
import urllib.parse
import xml.etree.ElementTree as ElementTree

XHTML = "{http://www.w3.org/1999/xhtml}"
SVG = "{http://www.w3.org/2000/svg}"
FORBIDDEN = {XHTML + name for name in ("script", "iframe", "object", "embed", "link", "base", "img", "form")}


def references(root):
    for element in root.iter():
        for name, value in element.attrib.items():
            if name.split("}")[-1] in ("href", "src", "srcset", "data", "action"):
                yield element, value


def defects(page, folder):
    text = open(page, encoding="utf-8").read()
    try:
        root = ElementTree.fromstring(text.replace("<!DOCTYPE html>", "", 1))
    except ElementTree.ParseError as error:
        yield f"not well-formed: {error}"
        return
    ids = [element.attrib["id"] for element in root.iter() if "id" in element.attrib]
    for name in {name for name in ids if ids.count(name) > 1}:
        yield f"id {name} appears twice"
    for element in root.iter():
        if element.tag in FORBIDDEN:
            yield f"element {element.tag}"
        for name in element.attrib:
            if name.lower().startswith("on") or name == "style":
                yield f"attribute {name} of {element.tag}"
        for name in element.attrib.get("aria-labelledby", "").split():
            if name not in ids:
                yield f"aria-labelledby names {name}, which is absent"
    for element, value in references(root):
        if value.startswith("#"):
            if value[1:] not in ids:
                yield f"link to {value}, which is absent"
        elif not value.startswith("data:text/csv"):
            yield f"reference to {value[:60]}"
    style = "".join(root.find(f"{XHTML}head/{XHTML}style").itertext())
    if re.search(r"url\(|@import|https?:", style):
        yield "the style refers to something outside"
    for svg in root.iter(SVG + "svg"):
        if svg.attrib.get("aria-hidden") == "true":
            continue
        if svg.find(SVG + "title") is None or svg.find(SVG + "desc") is None:
            yield "a drawing without title or description"
        for shape in svg.iter():
            for key in ("x", "y", "x1", "x2", "y1", "y2", "cx", "cy", "width", "height", "points", "transform"):
                if re.search(r"nan|inf", shape.attrib.get(key, "")):
                    yield f"{shape.tag} with {key} = {shape.attrib[key][:40]}"
    for table in root.iter(XHTML + "table"):
        if table.find(XHTML + "caption") is None:
            yield "a table without caption"
    for figure in root.iter(XHTML + "figure"):
        if figure.find(f".//{XHTML}a[@download]") is None:
            yield f"figure {figure.attrib.get('id')} without its numbers"
    links = {link.attrib["download"]: link.attrib["href"] for link in root.iter(XHTML + "a") if "download" in link.attrib}
    if sorted(links) != sorted(os.listdir(folder)):
        yield f"the page has {sorted(links)}, the folder {sorted(os.listdir(folder))}"
        return
    for name, link in links.items():
        inside = urllib.parse.unquote(link.split(",", 1)[1])
        if inside != open(os.path.join(folder, name), encoding="utf-8", newline="").read():
            yield f"{name} differs between page and folder"


found = list(defects(sys.argv[1], sys.argv[2]))
for defect in found:
    print(defect)
sys.exit(1 if found else 0)
