# From `objdump -dC --no-show-raw-insn` of an object: for each sweep with a packed square root, the smallest loop around
# it. One line a loop: its terms (P of every fluid, L laminar, A artificial viscosity, D density diffusion, M central
# viscosity, T tensile correction, X XSPH), instructions, stores to the stack, loads from it, divisions.
function operands(text) { sub(/^[^ \t]+[ \t]+/, "", text); return text }
function finish(    r, k, to, from, at, n, stores, loads, divisions, text, terms) {
    if (name !~ /sweep/) return
    for (r = 0; r < count; ++r) {
        if (line[r] !~ /^v?sqrtp[ds]/) continue
        from = -1; at = -1
        for (k = r + 1; k < count; ++k)
            if (line[k] ~ /^j[a-z]+ /) {
                to = operands(line[k]); sub(/[ \t].*/, "", to)
                if (to in place && place[to] <= r && (from < 0 || k - place[to] < at - from)) { from = place[to]; at = k }
            }
        if (from < 0) continue
        n = stores = loads = divisions = 0
        for (k = from; k <= at; ++k) {
            text = line[k]; ++n
            if (text ~ /^v?divp/) ++divisions
            if (text ~ /,[^,]*\(%r[sb]p[^)]*\)$/) { if (text !~ /^(cmp|test)/) ++stores }
            else if (text ~ /\(%r[sb]p\)/) ++loads
        }
        terms = "P"
        if (name ~ /LaminarViscosity/) terms = terms "L"
        if (name ~ /ArtificialViscosity/) terms = terms "A"
        if (name ~ /Fourtakas/) terms = terms "D"
        if (name ~ /MonaghanCleary/) terms = terms "M"
        if (name ~ /TensileCorrection/) terms = terms "T"
        if (name ~ /Xsph/) terms = terms "X"
        print terms, n, stores, loads, divisions
    }
}
/^[0-9a-f]+ <.*>:$/ { finish(); name = $0; count = 0; delete place; delete line; next }
/^ *[0-9a-f]+:\t/ {
    address = $1; sub(/:$/, "", address)
    text = $0; sub(/^[^\t]*\t/, "", text); sub(/[ \t]+$/, "", text)
    place[address] = count; line[count++] = text
}
END { finish() }
