#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The authority of make_security.sh under attack: stolen keys, roles taken away, runs that are killed, runs at one time,
# odd names. What counts is what openssl says of every certificate that was ever issued.
# Usage: authority_test.sh SCRIPT
set -uo pipefail
script=$(realpath "$1")
work=$(mktemp -d "${TMPDIR:-/tmp}/ehm-authority.XXXXXX")
trap 'rm -rf "$work" "$work.tree"' EXIT
cd "$work" || exit 1
failures=0
wrong() { echo "authority_test: $1"; failures=$((failures + 1)); }
checked() { echo "$((SECONDS)) s: $1"; }
# run ARGUMENT...: must succeed; what it says goes to `said`.
run() { said=$("$script" "$@" 2>&1) || wrong "'$*' gave $?: $said"; }

# accepted DIR CERT: as a participant looks at it that has the list of DIR, if there is one.
accepted() {
  local list=()
  [ ! -f "$1/ca/identity_crl.pem" ] || list=(-crl_check -CRLfile "$1/ca/identity_crl.pem")
  openssl verify "${list[@]}" -CAfile "$1/ca/identity_ca.pem" "$2" >/dev/null 2>&1
}
signed_subject() {
  openssl smime -verify -in "$1/permissions.p7s" -CAfile "$1/permissions_ca.pem" 2>/dev/null | sed -n 's:.*<subject_name>\(.*\)</subject_name>.*:\1:p'
}
subject() { openssl x509 -in "$1/cert.pem" -noout -subject -nameopt RFC2253 | sed 's/^subject=//'; }
serial() { openssl x509 -in "$1/cert.pem" -noout -serial | sed 's/^serial=//'; }

# sound DIR WHEN: register, list, certificates, keys and permissions tell one story, and nothing lies about.
sound() {
  local dir=$1 when=$2 folder valid=0 left certificate
  left=$(find "$dir" \( -name '.staging*' -o -name .ready -o -name 'new.*' -o -name '*.new' -o -name request \))
  [ -z "$left" ] || wrong "$when: left behind: $left"
  [ "$(find "$dir/ca/issued" -type f | wc -l)" = "$(wc -l <"$dir/ca/register")" ] ||
    wrong "$when: not everything that was issued is in the register"
  for folder in "$dir"/*/; do
    [ "$folder" != "$dir/ca/" ] || continue
    folder=${folder%/}
    openssl verify -CAfile "$dir/ca/identity_ca.pem" "$folder/cert.pem" >/dev/null 2>&1 ||
      wrong "$when: $folder: certificate"
    certificate=$(openssl x509 -in "$folder/cert.pem" -noout -serial -subject -pubkey -nameopt RFC2253 2>&1)
    [[ $certificate == *"$(openssl pkey -in "$folder/key.pem" -pubout 2>&1)"* ]] ||
      wrong "$when: $folder: key of another certificate"
    [[ $certificate$'\n' == *"subject=$(signed_subject "$folder")"$'\n'* ]] ||
      wrong "$when: $folder: permissions of another certificate"
    cmp -s "$dir/ca/identity_crl.pem" "$folder/identity_crl.pem" || [ ! -f "$dir/ca/identity_crl.pem" ] ||
      wrong "$when: $folder: an old list"
    ! grep -q "^V.*$(sed -n 's/^serial=//p' <<<"$certificate")" "$dir/ca/register" || valid=$((valid + 1))
  done
  [ "$(grep -c ^V "$dir/ca/register")" = "$valid" ] || wrong "$when: a certificate is valid that nobody has"
}

# --- stolen keys ---
run --out s
mkdir old
cp -r s/viewer old/viewer-1
run --out s --role viewer --renew
cp -r s/viewer old/viewer-2
accepted s old/viewer-1/cert.pem && wrong "renewed: the predecessor is still accepted"
accepted s s/viewer/cert.pem || wrong "renewed: the new certificate is not accepted"
accepted s s/monitor/cert.pem || wrong "renewed: somebody else is not accepted"
sound s "renewed"
checked "renewal revokes its predecessor, and nobody else"

run --out s --role viewer --renew --keep-old
cp -r s/viewer old/viewer-3
accepted s old/viewer-2/cert.pem || wrong "--keep-old: not kept"
run --out s --revoke-old viewer
accepted s old/viewer-2/cert.pem && wrong "--revoke-old: the old one is accepted"
accepted s s/viewer/cert.pem || wrong "--revoke-old: the newest is not accepted"
run --out s --role viewer --renew --keep-old
cp -r s/viewer old/viewer-4
run --out s --revoke viewer
for each in old/viewer-*; do accepted s "$each/cert.pem" && wrong "--revoke: $each is accepted"; done
[ "$(openssl crl -in s/ca/identity_crl.pem -noout -text | grep -c 'Serial Number')" = 4 ] ||
  wrong "--revoke: not four in the list"
for each in s/*/cert.pem; do
  cmp -s s/ca/identity_crl.pem "$(dirname "$each")/identity_crl.pem" || wrong "--revoke: $each has an old list"
done
before=$(cat s/ca/register)
run --out s --revoke viewer
[ "$before" = "$(cat s/ca/register)" ] || wrong "--revoke, again: something changed"
rm s/ca/identity_crl.pem s/monitor/identity_crl.pem
run --out s --revoke viewer
for each in old/viewer-*; do accepted s "$each/cert.pem" && wrong "--revoke, with a lost list: $each is accepted"; done
cmp -s s/ca/identity_crl.pem s/monitor/identity_crl.pem || wrong "--revoke, with a lost list: not handed out"
checked "--keep-old, --revoke-old; --revoke revokes all four that the name ever had"

cp -r s/operator old/operator-1
rm -rf s/operator
run --out s # one of each: the lost one is told, not replaced in silence
[[ $said == *"operator was issued before"* && ! -e s/operator ]] || wrong "a lost folder: $said"
run --out s --revoke operator
accepted s old/operator-1/cert.pem && wrong "--revoke: a lost folder's certificate is accepted"
run --out s --role operator
accepted s s/operator/cert.pem || wrong "--revoke: the name is not free again"
rm -rf s/ca/issued/*
cp -r s/operator old/operator-2
run --out s --revoke operator
accepted s old/operator-2/cert.pem && wrong "--revoke: needs the copies of the authority"
last=$(date -d "$(openssl crl -in s/ca/identity_crl.pem -noout -lastupdate | sed 's/.*=//')" +%s)
[ $(($(date +%s) - last)) -gt 1800 ] || wrong "the list is not back-dated: a clock that is behind accepts nobody"
checked "--revoke of lost folders, by the register alone; the list is back-dated"

# --- a role that is taken away ---
run --out r --role operator
cp -r r/operator old/role-1
before=$(find r -type f ! -name .lock -exec sha256sum {} + | sort)
said=$("$script" --out r --role viewer --name operator 2>&1) && wrong "another role without --renew: accepted"
[[ $said == *"has the role operator, not viewer; --renew"* && $(wc -l <<<"$said") = 1 ]] ||
  wrong "another role without --renew: $said"
[ "$before" = "$(find r -type f ! -name .lock -exec sha256sum {} + | sort)" ] ||
  wrong "another role without --renew: something changed"
run --out r --role viewer --name operator --renew
cp -r r/operator old/role-2
run --out r --renew # one of each: the role stays
cp -r r/operator old/role-3
[ "$(grep -c '<publish>' r/operator/permissions.xml)" = 0 ] ||
  wrong "--renew of one of each gives a role back that was taken"
run --out r --name operator --renew
[[ $(subject r/operator) == "CN=operator,OU=viewer generation 4,"* ]] || wrong "--renew by name: the role does not stay"
[ "$(grep -c '<publish>' r/operator/permissions.xml)" = 0 ] || wrong "the role is not taken away"
for key in 1 2 3; do
  for permissions in 1 2 3; do
    fits=no
    [ "$(subject old/role-$key)" != "$(signed_subject old/role-$permissions)" ] || fits=yes
    [ "$fits" = "$([ $key = $permissions ] && echo yes || echo no)" ] ||
      wrong "permissions $permissions with key $key: fits: $fits"
  done
done
accepted r old/role-1/cert.pem && wrong "the key of the old role is accepted"
"$script" --out r --role operator --name operator --renew --keep-old >/dev/null 2>&1 && wrong "--keep-old leaves two roles"
sound r "role taken away"
checked "permissions fit the key of their own generation only; another role needs --renew"

# --- runs that are killed ---
# At each command that touches files: the shim ends the whole run there, as power does.
mkdir shim
for command in mv cp rm rmdir mkdir mktemp chmod install sync; do
  # shellcheck disable=SC2016  # the shim's variables
  printf '#!/bin/sh\necho %s >>"$EHM_COUNT"\nn=0\nwhile read -r _; do n=$((n + 1)); done <"$EHM_COUNT"\n[ $n -ne "$EHM_KILL_AT" ] || kill -KILL 0\nexec %s "$@"\n' \
    $command "$(command -v $command)" >shim/$command
  chmod +x shim/$command
done
# killed_at N ARGUMENT...: false if the run ended before its Nth command.
killed_at() {
  local at=$1
  shift
  : >count
  { PATH=$work/shim:$PATH EHM_COUNT=$work/count EHM_KILL_AT=$at setsid -w "$script" "$@" >/dev/null; } 2>/dev/null
  [ $? = 137 ]
}
run --out base --role viewer
run --out base --role viewer --renew # there is a list from here on
first=$(serial base/viewer)
changed=no moments=0
cp -a base k
killed_at 0 --out k --role viewer --renew
until_sync=$(awk '$1 == "sync" { print NR; exit }' count) # before it is on the disk, every fifth will do
for ((at = 1; at < 100; at += (at < ${until_sync:-100} - 5 ? 5 : 1))); do
  rm -rf k
  cp -a base k
  killed_at $at --out k --role viewer --renew || break
  moments=$((moments + 1))
  run --out k --role viewer # whatever is asked for next
  sound k "renewal killed at command $at"
  if [ "$(serial k/viewer)" != "$first" ]; then changed=yes; else
    [ $changed = no ] || wrong "renewal killed at command $at: the old state after the new one"
    accepted k base/viewer/cert.pem || wrong "renewal killed at command $at: the old one neither kept nor replaced"
  fi
done
[[ $moments -gt 12 && $at -lt 100 && $changed == yes ]] || wrong "a renewal: killed at $moments commands only"
checked "a renewal that is killed at $moments of its $((at - 1)) file commands: old state or new"

for ((at = 1; at < 100; at += 5)); do
  rm -rf k
  cp -a base k
  killed_at $at --out k --force --role viewer || break
  run --out k --role viewer
  sound k "--force killed at command $at"
done
[[ $at -gt 8 && $at -lt 100 ]] || wrong "--force: killed at $at commands only"
checked "--force, killed at every fifth of its file commands"

for ((i = 0; i < 3; i++)); do
  delay_ms=$((10 + RANDOM % 290)) dir=f$i
  delay=0.$(printf %03d $delay_ms)
  "$script" --out "$dir" >/dev/null 2>&1 &
  pid=$!
  sleep "$delay"
  kill -KILL $pid 2>/dev/null # alone: an openssl may outlive it
  wait $pid 2>/dev/null
  run --out "$dir"
  sound $dir "making all, killed after $delay_ms ms"
done
for ((i = 0; i < 3; i++)); do
  delay_ms=$((10 + RANDOM % 290))
  delay=0.$(printf %03d $delay_ms)
  timeout -s INT "$delay" "$script" --out f0 --renew >/dev/null 2>&1
  [ -z "$(find f0 -name '.staging*' -o -name .ready)" ] || wrong "interrupted after $delay_ms ms: it leaves something behind"
  sound f0 "interrupted after $delay_ms ms"
done
checked "killed after 10 to 300 ms, and run again; interrupted, and looked at as it is"

# --- runs at one time ---
pids=() names=(p1 p2 p3 p4)
for each in "${names[@]}"; do
  "$script" --out p --role viewer --name "$each" >"$each.log" 2>&1 &
  pids+=($!)
done
for pid in "${pids[@]}"; do wait "$pid" || wrong "at one time: one failed: $(cat p?.log)"; done
for each in "${names[@]}"; do [ -f "p/$each/cert.pem" ] || wrong "at one time: $each is not there"; done
[ "$(cat p?.log | grep -c "^made .*/ca ")" = 1 ] || wrong "at one time: more than one authority"
sound p "at one time"
"$script" --out p --revoke p1 >/dev/null 2>&1 &
"$script" --out p --role viewer --name p2 --renew >/dev/null 2>&1 &
wait
sound p "revoked and renewed at one time"
[ "$(openssl crl -in p/ca/identity_crl.pem -noout -text | grep -c 'Serial Number')" = 2 ] ||
  wrong "at one time: a revocation is lost"
checked "runs at one time: all are issued, by one authority; no revocation is lost"

# --- odd names, wrong usage ---
# refused TEXT ARGUMENT...: exit 2, one line with the text, and nothing is touched.
refused() {
  local text=$1 code=0 message
  shift
  message=$("$script" "$@" 2>&1) || code=$?
  [[ $code == 2 && $(wc -l <<<"$message") == 1 && $message == "make_security: "*"$text"* ]] ||
    wrong "$(printf '%q ' "$@")gave $code: $message"
}
tree() { find . -path ./p/.lock -prune -o -type f -print0 | sort -z | xargs -0 sha256sum; }
tree >"$work.tree"
# shellcheck disable=SC2016  # as it is
for name in ../x ../p/p1 a/b 'a b' 'a;b' "a'b" 'a"b' 'a$b' $'a\nb' $'p1\n' -x .x . .. ca '' '*' é 0123456789012345678901234567890123456789012345678901234567890; do
  refused "is '${name//$'\n'/?}', allowed is 1 to 60 letters" --out p --role viewer --name "$name"
  refused "is '${name//$'\n'/?}', allowed is 1 to 60 letters" --out p --revoke "$name"
done
refused "'nobody' was never issued by" --out p --revoke nobody
refused "allowed are: p1 p2 p3 p4" --out p --revoke nobody
refused "cannot be renewed, allowed are: p1 p2 p3 p4" --out p --role viewer --name nobody --renew
refused "allowed is a folder with an authority" --out nowhere --revoke p1
refused "'p2' has the role viewer, not operator; --renew" --out p --role operator --name p2
refused "'p1' is revoked; --renew" --out p --role viewer --name p1
for domains in 3 9-3 0-233 -1-5 1-2-3 a-b 0x1-5 ' 1-2' 1- 0000-1; do refused "--domains is '$domains', allowed is MIN-MAX within 0-232" --out q --domains "$domains"; done
for time in 0d 5 5y '5 d' -1d 010d 3651d 999999999d; do refused "--valid-for is '$time', allowed is" --out q --valid-for "$time"; done
refused "--role is 'pilot', allowed is sensor_source, monitor, viewer or operator" --out q --role pilot
refused "--protection is 'none', allowed is sign or encrypt" --out q --protection none
refused "unknown argument '--fast', allowed are --out," --out q --fast
refused "unknown argument 'monitor', allowed are --out," --out q monitor
refused "option '--role' needs a value: sensor_source, monitor, viewer or operator" --out q --role
refused "option '--revoke' needs a value: 1 to 60" --out q --revoke
refused "option '--out' needs a value" --out
refused "--out is '--force', allowed is a folder" --out --force
refused "--out is '-x', allowed is a folder (./-x" --out -x
refused "--out is '', allowed is" --out ''
refused "allowed is a folder without control characters" --out $'q\nq'
refused "allowed is a folder that is there or can be made" --out p/p1/cert.pem/q
refused "--out is missing" --role viewer
refused "option '--role' is given twice" --out q --role viewer --role operator
refused "--name needs --role" --out q --name x
refused "--keep-old needs --renew" --out p --role viewer --name p2 --keep-old
refused "--force makes everything anew" --out p --force --renew
refused "--role does not go with --revoke" --out p --revoke p2 --role viewer
tree | cmp -s - "$work.tree" || wrong "what was refused has changed something"
mkdir p/mine && touch p/mine/letter
"$script" --out p --role viewer --name mine >/dev/null 2>&1 && wrong "a folder that is no identity is replaced"
[ -f p/mine/letter ] || wrong "a folder that is no identity is gone"
checked "names, times and options that are not allowed: one line, exit 2, nothing touched"

odd=$'o d;d\'"$HOME#\\`%*[\xc3\xa4] '
run --out "./$odd/-x" --role viewer
run --out "./$odd/-x" --role viewer --renew
cp -r "./$odd/-x" copy
sound copy "odd characters in --out"
made=(o*)
[[ -f $odd/-x/viewer/cert.pem && "${made[*]}" == "$odd old" ]] || wrong "odd characters in --out: another place"
run --out d --role viewer --domains 010-020
[[ $(cat d/ca/made_with d/viewer/permissions.xml) == *"domains=10-20"*"<min>10</min><max>20</max>"* ]] ||
  wrong "--domains 010-020: $(cat d/ca/made_with)"
run --out d --domains 10-020
checked "odd characters in --out; --domains 010-020 is decimal"

[ $failures = 0 ] || { echo "authority_test: $failures failures"; exit 1; }
echo "authority_test: passed in $SECONDS s"
