#include "motion/fields/expression.h"

#include <muParser.h>
#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <numbers>

namespace kinemesh {
namespace {

// muParser parsers write to their own buffers even when they only evaluate.
struct Parser {
  Parser(const std::string& text, FormulaIn in) {
    if (in == FormulaIn::PlaceAndTime) {
      parser.DefineVar("x", &x);
      parser.DefineVar("y", &y);
    }
    parser.DefineVar("t", &t);
    parser.DefineConst("pi", std::numbers::pi);
    parser.SetExpr(text);
  }
  Parser(const Parser&) = delete;  // the parser points to the variables
  Parser& operator=(const Parser&) = delete;

  double x = 0.0, y = 0.0, t = 0.0;
  mu::Parser parser;
};

[[noreturn]] void refuse(const std::string& key, const std::string& text, const std::string& why,
                         std::size_t at) {
  throw ParameterError(key, key + " = \"" + text + "\": " + why + " at character " + std::to_string(at + 1));
}

// muParser has assignments, which would change the variables.
void refuse_assignment(const std::string& key, const std::string& text, FormulaIn in) {
  const std::string expected = in == FormulaIn::Time ? "t" : "x, y and t";
  for (std::size_t i = text.find('='); i != std::string::npos; i = text.find('=', i + 1)) {
    if (i + 1 < text.size() && text[i + 1] == '=')
      ++i;
    else if (i == 0 || std::string("<>!").find(text[i - 1]) == std::string::npos)
      refuse(key, text, "an assignment; only a formula in " + expected + " is expected", i);
  }
}

// Without the position, which counts from 0, and the full stop.
std::string reason(const mu::Parser::exception_type& error, FormulaIn in) {
  const std::string token = error.GetToken();
  if (in == FormulaIn::Time && (token == "x" || token == "y"))
    return "only a formula in t is expected, but there is " + token;
  const std::string message = error.GetMsg();
  for (const char* tail : {" found at position", " at position", "."})
    if (const auto end = message.rfind(tail); end != std::string::npos && end > 0)
      return message.substr(0, end);
  return message;
}

void check(const std::string& key, const std::string& text, FormulaIn in) {
  refuse_assignment(key, text, in);
  try {
    Parser parser(text, in);
    int n_results = 0;
    parser.parser.Eval(n_results);
    if (n_results != 1) refuse(key, text, "more than one formula; the next starts", text.find(','));
  } catch (const mu::Parser::exception_type& error) {
    const auto at =
        static_cast<std::size_t>(error.GetPos());  // from 0; beyond the end, or -1, for what is missing
    refuse(key, text, reason(error, in), std::min(at, text.size()));
  }
}

}  // namespace

struct Formula::Parsers {
  Parsers(const std::string& text, FormulaIn in) : of_thread([text, in] { return Parser(text, in); }) {}
  tbb::enumerable_thread_specific<Parser> of_thread;
};

Formula::Formula(const std::string& key, const std::string& text, FormulaIn in) {
  check(key, text, in);
  parsers_ = std::make_unique<Parsers>(text, in);
}
Formula::~Formula() = default;
Formula::Formula(Formula&&) noexcept = default;
Formula& Formula::operator=(Formula&&) noexcept = default;

double Formula::operator()(const Point& x, double t) const {
  Parser& mine = parsers_->of_thread.local();
  mine.x = x.x;
  mine.y = x.y;
  mine.t = t;
  return mine.parser.Eval();
}

ExpressionVelocity::ExpressionVelocity(const std::string& u, const std::string& v) : u_("u", u), v_("v", v) {}

ExpressionDisplacement::ExpressionDisplacement(const std::string& dx, const std::string& dy)
    : dx_("dx", dx), dy_("dy", dy) {}

}  // namespace kinemesh
