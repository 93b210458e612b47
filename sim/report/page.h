// The page that reports are made of, with places for the data. Internal to sim/report/.
#pragma once

#include <string>
#include <string_view>

namespace kinemesh::report {

std::string_view page_template();  // web/report.html, as it was when the program was built

std::string base64(std::string_view bytes);
std::string deflated(std::string_view bytes);  // zlib's format

// The page with its two blocks of data, given as base64.
std::string fill_page(std::string_view data, std::string_view frames);

}  // namespace kinemesh::report
