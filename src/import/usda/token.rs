//! The words of a `.usda` text.

use super::UsdaError;

/// A word of the text.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Token {
    /// A name or keyword, with its colons and dots.
    Word(String),
    /// A number.
    Number(f64),
    /// Text in quotes.
    Text(String),
    /// A file, between @.
    Asset(String),
    /// A path, between < and >.
    Path(String),
    /// A single sign.
    Sign(char),
    /// Nothing more.
    End,
}

/// Gives a text word by word.
pub(super) struct Tokens<'t> {
    rest: &'t str,
    line: usize,
    ahead: Option<(Token, usize)>,
}

impl<'t> Tokens<'t> {
    /// Those of a text.
    pub(super) fn new(text: &'t str) -> Self {
        Self { rest: text, line: 1, ahead: None }
    }

    /// The next word, and its line.
    pub(super) fn next(&mut self) -> Result<(Token, usize), UsdaError> {
        match self.ahead.take() {
            Some(token) => Ok(token),
            None => self.read(),
        }
    }

    /// The next word, which stays.
    pub(super) fn peek(&mut self) -> Result<&Token, UsdaError> {
        if self.ahead.is_none() {
            self.ahead = Some(self.read()?);
        }
        Ok(self.ahead.as_ref().map_or(&Token::End, |(token, _)| token))
    }

    /// The line of the next word.
    pub(super) fn line(&mut self) -> Result<usize, UsdaError> {
        self.peek()?;
        Ok(self.ahead.as_ref().map_or(self.line, |(_, line)| *line))
    }

    /// Whether the next word is that sign; then it is taken.
    pub(super) fn take(&mut self, sign: char) -> Result<bool, UsdaError> {
        let found = *self.peek()? == Token::Sign(sign);
        if found {
            self.next()?;
        }
        Ok(found)
    }

    /// Takes that sign.
    pub(super) fn expect(&mut self, sign: char) -> Result<(), UsdaError> {
        let (token, line) = self.next()?;
        if token == Token::Sign(sign) { Ok(()) } else { Err(unexpected(&token, line, &format!("`{sign}`"))) }
    }

    fn read(&mut self) -> Result<(Token, usize), UsdaError> {
        self.skip_blanks();
        let line = self.line;
        let Some(first) = self.rest.chars().next() else { return Ok((Token::End, line)) };
        let token = match first {
            '"' | '\'' => Token::Text(self.quoted(first)?),
            '@' => {
                let fence = if self.rest.starts_with("@@@") { "@@@" } else { "@" };
                Token::Asset(self.fenced(fence, fence)?.to_owned())
            }
            '<' => Token::Path(self.fenced("<", ">")?.to_owned()),
            c if c.is_ascii_digit() || matches!(c, '-' | '+' | '.') => self.number(),
            c if is_of_word(c) && c != ':' => Token::Word(self.word().to_owned()),
            sign => {
                self.advance(sign.len_utf8());
                Token::Sign(sign)
            }
        };
        Ok((token, line))
    }

    /// Goes on by that many bytes, counting lines.
    fn advance(&mut self, bytes: usize) -> &'t str {
        let (done, rest) = self.rest.split_at(bytes);
        self.line += done.bytes().filter(|byte| *byte == b'\n').count();
        self.rest = rest;
        done
    }

    fn skip_blanks(&mut self) {
        loop {
            let blanks = self.rest.len() - self.rest.trim_start().len();
            self.advance(blanks);
            if !self.rest.starts_with('#') {
                return;
            }
            let end = self.rest.find('\n').unwrap_or(self.rest.len());
            self.advance(end);
        }
    }

    fn word(&mut self) -> &'t str {
        let end = self.rest.find(|c: char| !is_of_word(c)).unwrap_or(self.rest.len());
        self.advance(end)
    }

    fn number(&mut self) -> Token {
        let is_part = |c: char| c.is_ascii_alphanumeric() || matches!(c, '+' | '-' | '.');
        let end = self.rest.find(|c: char| !is_part(c)).unwrap_or(self.rest.len());
        let text = self.advance(end);
        text.parse().map_or_else(|_| Token::Word(text.to_owned()), Token::Number)
    }

    /// What stands between two marks.
    fn fenced(&mut self, open: &str, close: &str) -> Result<&'t str, UsdaError> {
        let line = self.line;
        let inner = &self.rest[open.len()..];
        let Some(end) = inner.find(close) else {
            return Err(UsdaError::Syntax { line, what: format!("`{open}` is not closed by `{close}`") });
        };
        self.advance(open.len() + end + close.len());
        Ok(&inner[..end])
    }

    /// Text between single or triple quotes, with its escapes resolved.
    fn quoted(&mut self, quote: char) -> Result<String, UsdaError> {
        let line = self.line;
        let triple = String::from_iter([quote; 3]);
        let fence = if self.rest.starts_with(&triple) { triple } else { quote.to_string() };
        let inner = &self.rest[fence.len()..];
        let mut text = String::new();
        let mut chars = inner.char_indices();
        while let Some((at, c)) = chars.next() {
            if inner[at..].starts_with(&fence) {
                self.advance(2 * fence.len() + at);
                return Ok(text);
            }
            if c != '\\' {
                text.push(c);
                continue;
            }
            match chars.next() {
                Some((_, 'n')) => text.push('\n'),
                Some((_, 't')) => text.push('\t'),
                Some((_, other)) => text.push(other),
                None => break,
            }
        }
        Err(UsdaError::Syntax { line, what: format!("a text is not closed by {fence}") })
    }
}

fn is_of_word(c: char) -> bool {
    c.is_alphanumeric() || matches!(c, '_' | ':' | '.')
}

/// An error that says what stands in a place, and what should.
pub(super) fn unexpected(token: &Token, line: usize, wanted: &str) -> UsdaError {
    let found = match token {
        Token::Word(word) => format!("`{word}`"),
        Token::Number(number) => format!("`{number}`"),
        Token::Text(_) => "a text".to_owned(),
        Token::Asset(_) => "a file's name".to_owned(),
        Token::Path(path) => format!("`<{path}>`"),
        Token::Sign(sign) => format!("`{sign}`"),
        Token::End => "the end of the file".to_owned(),
    };
    UsdaError::Syntax { line, what: format!("{found} stands where {wanted} should") }
}
