# cmake -DPAGE=web/report.html -DOUT=page_template.cpp -P embed_page.cmake: the page as an array of bytes.
file(READ "${PAGE}" hex HEX)
string(REGEX REPLACE "(..)" "0x\\1," bytes "${hex}")
string(REGEX REPLACE "((0x..,)(0x..,)(0x..,)(0x..,)(0x..,)(0x..,)(0x..,)(0x..,))" "\\1\n" bytes "${bytes}")
file(WRITE "${OUT}" "#include \"sim/report/page.h\"

namespace kinemesh::report {
namespace {
constexpr unsigned char bytes[] = {
${bytes}
};
}  // namespace

std::string_view page_template() {
  return {reinterpret_cast<const char*>(bytes), sizeof bytes};
}

}  // namespace kinemesh::report
")
