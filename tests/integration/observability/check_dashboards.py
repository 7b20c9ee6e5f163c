# SPDX-License-Identifier: Apache-2.0
"""Alert rules are YAML and the dashboard JSON, both with the structure that Prometheus and Grafana load.

Usage: check_dashboards.py DASHBOARDS_FOLDER. That the metrics exist is metrics_test.cpp's part.
"""
import json
import re
import sys

import yaml

folder = sys.argv[1]


def check(good, what):
    if not good:
        sys.exit(f"check_dashboards: {what}")


def balanced(expression):
    """No quoted bracket occurs in our expressions."""
    open_of = {")": "(", "]": "[", "}": "{"}
    stack = []
    for c in expression:
        if c in open_of.values():
            stack.append(c)
        elif c in open_of and (not stack or stack.pop() != open_of[c]):
            return False
    return not stack


with open(f"{folder}/alert_rules.yml") as file:
    groups = yaml.safe_load(file)["groups"]
rules = [rule for group in groups for rule in group["rules"]]
check(len({rule["alert"] for rule in rules}) == len(rules), "an alert is named twice")
for rule in rules:
    name = rule["alert"]
    check(set(rule) <= {"alert", "expr", "for", "labels", "annotations"}, f"{name}: unknown key")
    check(balanced(rule["expr"]), f"{name}: brackets of {rule['expr']}")
    check(re.fullmatch(r"\d+[smhd]", rule.get("for", "0s")), f"{name}: 'for' is no duration")
    check(rule["labels"]["severity"] in ("page", "ticket"), f"{name}: severity")
    check(rule["annotations"]["summary"].endswith("."), f"{name}: no summary")
    counters = re.findall(r"\b\w+_total\b(?!\S*\[)", rule["expr"])
    check(not counters, f"{name}: a counter needs rate or increase: {counters}")

with open(f"{folder}/grafana_ehm.json") as file:
    dashboard = json.load(file)
check(dashboard["uid"] and dashboard["title"] and dashboard["schemaVersion"] >= 30, "dashboard without identity")
panels = [panel for panel in dashboard["panels"] if panel["type"] != "row"]
check(len({panel["id"] for panel in dashboard["panels"]}) == len(dashboard["panels"]), "panel id twice")
cells = [(x, y) for panel in dashboard["panels"]
         for x in range(panel["gridPos"]["x"], panel["gridPos"]["x"] + panel["gridPos"]["w"])
         for y in range(panel["gridPos"]["y"], panel["gridPos"]["y"] + panel["gridPos"]["h"])]
check(len(set(cells)) == len(cells) and max(x for x, _ in cells) < 24, "panels overlap")
variables = {variable["name"] for variable in dashboard["templating"]["list"]}
for panel in panels:
    for target in panel["targets"]:
        check(balanced(target["expr"]), f"{panel['title']}: brackets of {target['expr']}")
        used = set(re.findall(r"\$(?!__)\{?(\w+)", target["expr"]))
        check(used <= variables, f"{panel['title']}: unknown variable in {target['expr']}")
print(f"{len(rules)} alert rules and {len(panels)} panels are in order")
