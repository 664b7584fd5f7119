//! The string literals of a source file, and where they stand.

use proc_macro2::{Delimiter, TokenStream, TokenTree};
use syn::Lit;

/// A literal with letters in it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Literal {
    pub text: String,
    /// What it is given to: `ui.label` is `label`, `Command::new`, `tf!`; that around it for one in a tuple or a list.
    pub call: String,
    /// Which argument it is, or part of.
    pub at: usize,
    /// The field of a struct that it is, or is part of.
    pub field: String,
    /// The function that it stands in.
    pub function: String,
}

/// All of them outside of attributes, comments and tests.
pub fn literals(source: &str) -> Vec<Literal> {
    let tokens: TokenStream = source.parse().expect("Rust");
    let mut found = Vec::new();
    walk(tokens, &Literal::default(), &mut found);
    found
}

fn walk(tokens: TokenStream, around: &Literal, found: &mut Vec<Literal>) {
    let tokens: Vec<TokenTree> = tokens.into_iter().collect();
    let mut here = around.clone();
    let mut is_test = false;
    for (k, token) in tokens.iter().enumerate() {
        let before = k.checked_sub(1).and_then(|k| tokens.get(k));
        match token {
            TokenTree::Literal(literal) => {
                if let Lit::Str(text) = Lit::new(literal.clone()) {
                    let text = text.value();
                    if text.contains(char::is_alphabetic) {
                        found.push(Literal { text, ..here.clone() });
                    }
                }
            }
            TokenTree::Punct(sign) if sign.as_char() == ',' => {
                here = Literal { at: here.at + 1, field: around.field.clone(), ..here };
            }
            TokenTree::Punct(sign) if sign.as_char() == ';' => (is_test, here) = (false, around.clone()),
            // `label: ...`, and not the `::` of a path.
            TokenTree::Punct(sign) if sign.as_char() == ':' => {
                if let (Some(TokenTree::Ident(name)), false) = (before, is(tokens.get(k + 1), ':')) {
                    here.field = name.to_string();
                }
            }
            TokenTree::Ident(word) if word == "fn" => {
                here.function = tokens.get(k + 1).map(ToString::to_string).unwrap_or_default();
            }
            // Attributes, and comments for documents, which are some.
            TokenTree::Group(group) if is(before, '#') || is_inner(&tokens[..k]) => {
                is_test |= group.stream().to_string().replace(' ', "") == "cfg(test)";
            }
            TokenTree::Group(group) if is_test => is_test = group.delimiter() != Delimiter::Brace,
            TokenTree::Group(group) => {
                let call = (group.delimiter() == Delimiter::Parenthesis).then(|| callee(&tokens[..k])).flatten();
                let inner = match call {
                    Some(call) => Literal { call, at: 0, ..here.clone() },
                    None if group.delimiter() == Delimiter::Brace => {
                        Literal { call: String::new(), at: 0, field: String::new(), ..here.clone() }
                    }
                    None => here.clone(),
                };
                walk(group.stream(), &inner, found);
            }
            _ => {}
        }
    }
}

/// `#!` before the brackets.
fn is_inner(before: &[TokenTree]) -> bool {
    matches!(before, [.., hash, bang] if is(Some(hash), '#') && is(Some(bang), '!'))
}

fn is(token: Option<&TokenTree>, sign: char) -> bool {
    matches!(token, Some(TokenTree::Punct(found)) if found.as_char() == sign)
}

/// The path, or the macro with its `!`, right before the arguments.
fn callee(before: &[TokenTree]) -> Option<String> {
    let (before, ending) = match before {
        [rest @ .., sign] if is(Some(sign), '!') => (rest, "!"),
        _ => (before, ""),
    };
    let [rest @ .., TokenTree::Ident(last)] = before else { return None };
    let path = match rest {
        [.., TokenTree::Ident(first), one, two] if is(Some(one), ':') && is(Some(two), ':') => {
            format!("{first}::{last}")
        }
        _ => last.to_string(),
    };
    Some(path + ending)
}
