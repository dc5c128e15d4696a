# Checks that the committed page is built from the committed sources, like reports/page/digest.mjs.
# usage: cmake -DPAGE=reports/page -P fresh.cmake
file(GLOB_RECURSE sources RELATIVE ${PAGE} ${PAGE}/src/*)
list(APPEND sources build.mjs digest.mjs package.json package-lock.json tsconfig.json)
list(SORT sources COMPARE STRING)
set(lines "")
foreach(source IN LISTS sources)
  file(SHA256 ${PAGE}/${source} digest)
  string(APPEND lines "${source} ${digest}\n")
endforeach()
string(SHA256 wanted "${lines}")
file(STRINGS ${PAGE}/dist/page.html recorded REGEX "name=\"assay-page-sources\"")
if(NOT recorded MATCHES "content=\"${wanted}\"")
  message(FATAL_ERROR "reports/page/dist/page.html was built from other sources: run `npm run build` "
    "in reports/page\n  sources ${wanted}\n  page    ${recorded}")
endif()
