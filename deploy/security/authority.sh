# SPDX-License-Identifier: Apache-2.0
# Sourced by make_security.sh: what was issued to whom, one run at a time, and each run whole or not at all.
#
# A run works on copies in DIR/.staging.X. When all is made, that folder is renamed to DIR/.ready: this instant is the
# change. Then its parts are moved into place. Who is cut off before has changed nothing; who is cut off after is
# completed by the next run, whatever that was asked for.

# shellcheck disable=SC2154  # variables of make_security.sh

lock_wait_s=300
parts=(identity_ca.pem identity_ca.key permissions_ca.pem permissions_ca.key governance.p7s register serial made_with)
everywhere='copy identity_crl.pem to every machine and restart its services'
stage=''
report=() # what is said once it is true

# Lines of the register (a file of openssl ca): state (V, or R: revoked), end, time of revocation, serial, file, subject.
# issued_to NAME: state, serial and role of each certificate, in the order of issue. No role: of an earlier script.
issued_to() {
  awk -F'\t' -v end="/CN=$1" 'substr($6, length($6) - length(end) + 1) == end {
    role = ""
    if (match($6, "/OU=[a-z_]+ generation ")) role = substr($6, RSTART + 4, RLENGTH - 16)
    print $1, $4, role }' "$ca/register"
}
issued_names() { sed 's:.*/CN=::' "$ca/register" | sort -u | paste -sd ' '; }

# revoke_in_register NAME SERIAL: all of NAME but that one. The register is enough: a folder may be lost, a file not.
revoke_in_register() {
  local now lines
  now=$(utc 0 %y%m%d%H%M%SZ)
  awk -F'\t' -v OFS='\t' -v end="/CN=$1" -v but="$2" -v now="$now" '
    $1 != "R" && $4 != but && substr($6, length($6) - length(end) + 1) == end { $1 = "R"; $3 = now } { print }' \
    "$ca/register" >"$ca/register.new" || broken "'$ca/register.new' cannot be written"
  lines=$(wc -l <"$ca/register")
  [ "$(wc -l <"$ca/register.new")" = "$lines" ] || broken "'$ca/register.new' was not written; is the disk full?"
  mv "$ca/register.new" "$ca/register"
  make_list "$ca"
}

# revoke_name NAME: for --revoke and --revoke-old.
revoke_name() {
  local issued but='' valid
  issued=$(issued_to "$1")
  [ -n "$issued" ] || fail "'$1' was never issued by '$ca', allowed are: $(issued_names)"
  [ -z "${given[--revoke-old]-}" ] || but=$(awk '{ last = $2 } END { print last }' <<<"$issued")
  valid=$(awk -v but="$but" '$1 != "R" && $2 != but { ++n } END { print n + 0 }' <<<"$issued")
  if [ "$valid" -gt 0 ]; then
    change_ca
    revoke_in_register "$1" "$but"
    report+=("revoked  $1 ($valid of $(wc -l <<<"$issued") certificates); $everywhere")
  else
    [ -f "$ca/identity_crl.pem" ] || { change_ca; make_list "$ca"; } # all is revoked, and the list was lost
    report+=("kept     $1: every certificate ${but:+but the newest }was revoked before")
  fi
}

# look_at NAME: what there is of it, as `state` (new, here, revoked, lost), `had` (its last role) and `about` (for people).
look_at() {
  local folder=$out/$1 issued known serial subject until
  issued=$(issued_to "$1")
  had=$(awk '{ role = $3 } END { print role }' <<<"$issued")
  known=$(awk 'NF && $1 != "R" { s = "lost" } END { print s }' <<<"$issued")
  state=${known:-new} about=''
  [ ! -L "$folder" ] || fail "'$folder' is a symbolic link, allowed is a folder"
  [ "$force" = no ] || [ ! -f "$folder/permissions.p7s" ] || return 0 # is going to be removed
  [ -n "$(ls -A "$folder" 2>/dev/null)" ] || return 0
  [ -f "$folder/cert.pem" ] || fail "'$folder' is there and is no identity, allowed is another --name, or another --out"
  read_certificate "$folder/cert.pem" || broken "'$folder/cert.pem' is not a certificate"
  known=$(awk -v serial="$serial" '$2 == serial { print $1 }' <<<"$issued")
  [ -n "$known" ] || fail "'$folder' was not issued by '$out/ca', allowed is another --name, or --force, which starts over"
  about="$subject, until $until"
  [ -n "$had" ] || about+="; of an earlier version, --renew binds its permissions to its key"
  state=here
  [ "$known" != R ] || state=revoked
}

# provide ROLE NAME ASKED: keeps the identity, makes it or makes it anew. Who asked for this very one is refused where he
# would not get it; who asked for one of each is told. The role may be empty with --renew: it stays.
provide() {
  local role=$1 name=$2 asked=$3 state had about identity=$out/$2 before
  look_at "$name"
  if [ "$renew" = yes ] && [ -n "$(issued_to "$name")" ]; then
    [ -n "$asked" ] || role=${had:-$role} # one of each: no role changes unasked
    [ -n "${role:=$had}" ] ||
      fail "'$name' is of an earlier version, which did not note its role: --role is needed, allowed is ${allowed[--role]}"
    [[ $keep_old == no || -z $had || $role == "$had" ]] ||
      fail "--keep-old would leave '$name' the role $had beside $role, allowed is the same role, or no --keep-old"
    change_ca
    before=$(issued_to "$name" | grep -vc ^R || true)
    [ "$keep_old" = yes ] || [ "$before" = 0 ] || revoke_in_register "$name" ''
    make_identity "$stage/put/$name" "$role" "$name"
    report+=("renewed  $identity ($about)")
    if [ "$keep_old" = yes ]; then
      report+=("kept     $before certificate(s) of before; --revoke-old $name revokes them")
    elif [ "$before" != 0 ]; then
      report+=("revoked  $before certificate(s) of before; $everywhere")
    fi
    return
  fi
  [ "$renew" = no ] || [ -z "$asked" ] ||
    fail "'$name' was never issued by '$out/ca' and cannot be renewed, allowed are: $(issued_names)"
  if [[ -n $asked && $state != new && -n $had && $role != "$had" ]]; then
    fail "'$name' has the role $had, not $role; --renew gives it the role and a new key, and revokes what it had"
  fi
  case $state in
    here) report+=("kept     $identity ($about)") ;;
    revoked | lost)
      local why="is revoked"
      [ "$state" = revoked ] || why="was issued before and is not in '$out'"
      [ -z "$asked" ] || fail "'$name' $why; --renew makes it anew and revokes what it had"
      report+=("kept     $name $why; --role $role --name $name --renew makes it anew")
      ;;
    new)
      change_ca
      make_identity "$stage/put/$name" "$role" "$name"
      report+=("made     $identity ($about)")
      ;;
  esac
}

is_identity() { [ -f "$1/permissions.p7s" ] && [ ! -L "${1%/}" ]; }

# open_authority: alone from here on, with the authority as `ca`, after whatever an earlier run has left.
open_authority() {
  local folder file asked tool
  for tool in openssl flock awk; do command -v "$tool" >/dev/null || broken "'$tool' is not installed"; done
  out=$(realpath -m -- "$out")
  if [[ -n $revoke || $renew == yes ]]; then
    [ -d "$out/ca" ] || [ -d "$out/.ready" ] ||
      fail "--out is '$out', allowed is a folder with an authority ('$out/ca') to revoke or renew"
  fi
  mkdir -p -- "$out" 2>/dev/null || fail "--out is '$out', allowed is a folder that is there or can be made"
  [ -w "$out" ] || fail "--out is '$out', allowed is a folder that you may write"
  exec 9>>"$out/.lock" # openssl inherits it: what a killed run has left behind is over before the next begins
  if ! flock -n 9; then
    echo "waiting  for another run on $out"
    flock -w "$lock_wait_s" 9 || broken "another run has held '$out/.lock' for $lock_wait_s s"
  fi
  rm -rf -- "$out"/.staging.*
  [ ! -d "$out/.ready" ] || echo "finished the change of a run that was interrupted"
  finish
  trap 'exit 130' INT
  trap 'exit 143' TERM
  trap 'exit 129' HUP
  trap 'rm -rf -- "$stage"' EXIT
  stage=$(mktemp -d "$out/.staging.XXXXXX")
  mkdir "$stage/put"

  ca=$out/ca
  [ ! -L "$ca" ] || fail "'$ca' is a symbolic link, allowed is a folder: give the one that it is in with --out"
  if [ "$force" = no ] && [ -n "$(ls -A "$ca" 2>/dev/null)" ]; then
    for file in "${parts[@]}"; do
      [ -f "$ca/$file" ] || broken "'$ca/$file' is missing: the authority is incomplete; --force starts over"
    done
    made_with=$(cat "$ca/made_with")
    for asked in ${protection:+"protection=$protection"} ${domains:+"domains=$domains"}; do
      [[ " $made_with " == *" $asked "* ]] || fail "'$ca' was made with $made_with, not $asked; --force starts over"
    done
    [ -n "$revoke" ] || report+=("kept     $ca ($made_with)")
    return
  fi
  if [ "$force" = yes ]; then
    [ -z "$(ls -A "$ca" 2>/dev/null)" ] || [ -f "$ca/identity_ca.key" ] || [ -f "$ca/made_with" ] ||
      fail "'$ca' is there and is no authority, allowed is another --out"
    for folder in "$out"/*/; do
      is_identity "$folder" || continue
      folder=${folder%/}
      printf '%s\0' "${folder##*/}" >>"$stage/remove"
      report+=("removed  $folder")
    done
  fi
  [[ -z $revoke && $renew == no ]] || fail "'$ca' is empty, allowed is a folder with an authority"
  ca=$stage/put/ca
  made_with="protection=${protection:-sign} domains=${domains:-0-230}"
  make_ca "$ca"
  report+=("made     $out/ca ($made_with)")
}

# Before the first change: the rest of the run works on a copy.
change_ca() {
  [ "$ca" != "$stage/put/ca" ] || return 0
  cp -a -- "$ca" "$stage/put/ca"
  ca=$stage/put/ca
  rm -rf "$ca"/new.* # of an earlier version that was interrupted
}

# commit: the change happens here, or never. On the disk before it counts: power may fail, too.
commit() {
  if [ -n "$(ls -A "$stage/put")" ]; then
    find "$stage" -exec sync -- {} +
    trap '' INT TERM HUP
    mv -T -- "$stage" "$out/.ready"
    sync -- "$out"
    finish
  fi
  hand_out_list
  printf '%s\n' "${report[@]}"
}

# finish: moves what is ready into place; may be cut off anywhere and called again.
finish() {
  local ready=$out/.ready name
  [ -d "$ready" ] || return 0
  trap '' INT TERM HUP
  if [ -f "$ready/remove" ]; then # before anything of the same name is put there
    while IFS= read -r -d '' name; do rm -rf -- "${out:?}/$name"; done <"$ready/remove"
    rm "$ready/remove"
  fi
  mkdir -p "$ready/old"
  for name in "$ready"/put/*; do
    name=${name##*/}
    if [ -e "$out/$name" ]; then
      rm -rf -- "$ready/old/$name"
      mv -T -- "$out/$name" "$ready/old/$name"
    fi
    mv -T -- "$ready/put/$name" "$out/$name"
  done
  hand_out_list
  mv -T -- "$ready" "$out/.staging.done"
  rm -rf -- "$out/.staging.done"
}

# hand_out_list: into every identity of this authority whose list is another one.
hand_out_list() {
  local list=$out/ca/identity_crl.pem folder
  [ -f "$list" ] || return 0
  for folder in "$out"/*/; do
    if ! is_identity "$folder" || ! cmp -s "$out/ca/identity_ca.pem" "$folder/identity_ca.pem" ||
      cmp -s "$list" "$folder/identity_crl.pem"; then continue; fi
    install -m 0644 "$list" "$out/.staging.list"
    mv -f -- "$out/.staging.list" "$folder/identity_crl.pem"
  done
}
