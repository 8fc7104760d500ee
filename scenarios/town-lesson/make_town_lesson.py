#!/usr/bin/env python3
"""Writes town-lesson.xosc from the town's scenario: the same car, lights and traffic, with a route over its streets.

    python3 make_town_lesson.py ../town/town.xosc > town-lesson.xosc
"""

import sys

# Road and lane of each waypoint, in the middle of its street, and the street's length.
WAYPOINTS = [
    ("20", -1, 80),
    ("64", -1, 80),
    ("54", -1, 80),
    ("43", -1, 80),
    ("48", -1, 80),
    ("87", -1, 80),
    ("99", -1, 80),
    ("38", -1, 80),
    ("92", -1, 80),
    ("103", -1, 80),
    ("31", -1, 80),
    ("10", -1, 80),
    ("113", 1, 60),
]


def replaced(text, old, new):
    if old not in text:
        raise SystemExit(f"the town's scenario has no {old!r}")
    return text.replace(old, new, 1)


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        text = file.read()
    text = replaced(text, "Written by make_town.py; change that and run it again.",
                    "Written by make_town_lesson.py; change that and run it again.")
    text = replaced(text, 'filepath="town.xodr"', 'filepath="../town/town.xodr"')
    begin = text.index('description="') + len('description="')
    text = text[:begin] + "A lesson in a town: a way through crossings of every kind, told turn by turn" + \
        text[text.index('"', begin):]
    lines = ['          <PrivateAction>', '            <RoutingAction>', '              <AssignRouteAction>',
             '                <Route name="through the town" closed="false">']
    for road, lane, s in WAYPOINTS:
        lines += ['                  <Waypoint routeStrategy="shortest">', '                    <Position>',
                  f'                      <LanePosition roadId="{road}" laneId="{lane}" s="{s}" offset="0"/>',
                  '                    </Position>', '                  </Waypoint>']
    lines += ['                </Route>', '              </AssignRouteAction>', '            </RoutingAction>',
              '          </PrivateAction>']
    at = text.index('        </Private>')
    text = text[:at] + "\n".join(lines) + "\n" + text[at:]
    sys.stdout.write(text)


if __name__ == "__main__":
    main()
