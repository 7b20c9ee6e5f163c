#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Each program's manual page reads without a warning and leaves nothing out: every configuration key of --print-config
# with its variable and flag, every option and command of --help. Usage: man_pages.sh PROGRAM...
# shellcheck disable=SC2086  # lists of words on purpose
set -euo pipefail
work=$(mktemp -d "${TMPDIR:-/tmp}/ehm-man.XXXXXX")
trap 'rm -rf "$work"' EXIT
fail() { echo "man pages: $*"; exit 1; }
export LC_ALL=C.UTF-8 MANWIDTH=100 MAN_KEEP_FORMATTING=

# render PAGE: as text into PAGE.txt, what the formatter complains of into PAGE.warnings.
render() { man --warnings -l "$1" 2>"$1.warnings" | col -b >"$1.txt"; }
# section.key of each "key = value" line.
keys() { "$1" --print-config | awk '/^\[/ {gsub(/[][]/, ""); section = $1} /^[a-z_0-9]+ = / {print section "." $1}'; }
# The long options that a help text introduces.
long_options() { grep -oE '^ +(-[a-z],)?--[a-z0-9-]+' | grep -oE '\-\-[a-z0-9-]+' | sort -u; }
require() { grep -qF -e "$2" "$1.txt" || fail "$(basename "$1") does not say $2"; }

for program in "$@"; do
  page=$work/$(basename "$program")
  "$program" --man >"$page"
  "$program" --help >"$page.help"
  render "$page"
  [ ! -s "$page.warnings" ] || fail "$(basename "$page"): $(cat "$page.warnings")"
  for heading in NAME SYNOPSIS DESCRIPTION OPTIONS 'EXIT STATUS' 'SEE ALSO'; do require "$page" "$heading"; done
  for option in $(long_options <"$page.help"); do require "$page" "$option"; done
  commands=$(grep -oE '^\.SS [a-z][a-z-]*$' "$page" | cut -c5- || true)
  for command in ${commands//\\/}; do
    for option in $("$program" "$command" --help | long_options); do require "$page" "$option"; done
  done
  count=0
  if grep -q -e --print-config "$page.help"; then
    for key in $(keys "$program"); do
      require "$page" "$key = "
      variable=EHM_${key//./_}
      require "$page" "${variable^^}"
      count=$((count + 1))
    done
    [ "$count" -gt 10 ] || fail "$(basename "$page"): --print-config showed only $count keys"
  fi
  echo "man pages: $(basename "$page"): $(echo $commands | wc -w) commands, $count configuration keys, no warning"
done

# Negative: the checks find a page that is broken, and a key that is missing.
printf '.TH x 1\n.SH NAME\nx \\- y\n.NOSUCHMACRO\n' >"$work/broken"
render "$work/broken"
[ -s "$work/broken.warnings" ] || fail "an unknown macro passes"
(require "$work/broken" dds.domain) >/dev/null && fail "a missing key passes"
exit 0
