#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# make_security.sh: what it makes verifies and is private, what exists is kept, wrong usage is refused.
# Usage: make_security_test.sh SCRIPT
set -euo pipefail
script=$(realpath "$1")
work=$(mktemp -d "${TMPDIR:-/tmp}/ehm-security.XXXXXX")
trap 'rm -rf "$work"' EXIT
cd "$work"
fail() { echo "make_security_test: $1"; exit 1; }
# refused TEXT ARGUMENT...: exit 2, and the message holds the text.
refused() {
  local text=$1 code=0 said
  shift
  said=$("$script" "$@" 2>&1) || code=$?
  [ "$code" = 2 ] && [[ $said == *"$text"* ]] || fail "'$*' gave $code: $said"
}

"$script" --out s --protection encrypt --domains 3-9 >made
for role in sensor_source monitor viewer operator; do
  openssl verify -CAfile s/$role/identity_ca.pem s/$role/cert.pem >/dev/null || fail "$role: certificate"
  for document in permissions governance; do
    openssl smime -verify -in s/$role/$document.p7s -CAfile s/$role/permissions_ca.pem >$document 2>/dev/null ||
      fail "$role: $document is not signed by its authority"
  done
  subject=$(openssl x509 -in s/$role/cert.pem -noout -subject -nameopt RFC2253)
  grep -q "<subject_name>${subject#subject=}</subject_name>" permissions || fail "$role: subject in permissions"
done
[ -z "$(find s \( -name '*.key' -o -name key.pem \) ! -perm 0600)" ] || fail "a private key that others can read"
grep -q '<metadata_protection_kind>ENCRYPT<' governance && grep -q '<min>3</min><max>9</max>' governance ||
  fail "the governance is not what was asked for"
grep -q '<rtps_protection_kind>NONE<' governance || fail "protection of whole messages lets a forged length through"
grep -q '<publish>' s/viewer/permissions.xml && fail "a viewer that may publish"
grep -q 'EngineSensors' s/viewer/permissions.xml && fail "a viewer that may read sensors"

sum() { cat s/*/*.pem s/ca/*.key | sha256sum; }
before=$(sum)
"$script" --out s >kept
[ "$before" = "$(sum)" ] && [ "$(grep -c '^kept ' kept)" = 5 ] || fail "a second run changed something"
"$script" --out s --role viewer --renew >/dev/null
[ "$before" != "$(sum)" ] || fail "--renew renewed nothing"
"$script" --out s --revoke viewer >/dev/null
openssl crl -in s/monitor/identity_crl.pem -noout -text | grep -q 'Serial Number' || fail "nothing is revoked"

refused "--force starts over" --out s --protection sign
refused "allowed is sensor_source, monitor, viewer or operator" --out s --role pilot
refused "--name is '../x'" --out s --role viewer --name ../x
refused "--valid-for is '5 years'" --out s --valid-for '5 years'
refused "--domains is '9-3'" --out s --domains 9-3
refused "allowed are: monitor operator sensor_source viewer" --out s --revoke nobody
refused "--out is missing"
refused "unknown argument '--fast'" --fast

"$script" --out s --force >/dev/null
openssl verify -CAfile s/ca/identity_ca.pem s/monitor/cert.pem >/dev/null || fail "after --force"
[ "$(cat s/ca/made_with)" = "protection=sign domains=0-230" ] || fail "--force kept the old rules"
echo "make_security_test: passed"
