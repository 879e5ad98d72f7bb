#!/usr/bin/env bash
# Builds one benchmark, runs it, keeps its figures as build/bench/NAME.json and draws its plot if it has one.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

names=()
for file in bench/*.cpp; do
    [[ ! -f $file ]] || names+=("$(basename "$file" .cpp)")
done
usage()
{
    cat <<END
usage: bash bench/run.sh NAME [options of Google Benchmark]

NAME is one of: ${names[*]-}
Writes build/bench/NAME.json.
END
}

case ${1-} in
    --help | -h) usage; exit 0 ;;
    "") usage >&2; exit 2 ;;
esac
name=$1
shift
[[ " ${names[*]-} " == *" $name "* ]] || {
    echo "run.sh: there is no benchmark $name; choose one of: ${names[*]-}" >&2
    exit 2
}

bash tools/setup.sh --with bench
cmake --preset bench > /dev/null
cmake --build --preset bench --target "bench_$name"
export OMP_WAIT_POLICY=${OMP_WAIT_POLICY-passive}
json=build/bench/$name.json
"$(find build/bench -name "bench_$name" -type f -perm -u+x | head -n 1)" \
    --benchmark_out="$json" --benchmark_out_format=json "$@"
sed -i '/"host_name"/d' "$json"
echo "figures: $json"
if [[ -f bench/plot.py ]]; then
    /usr/bin/python3 bench/plot.py "$name"
fi
