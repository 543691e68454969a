//! Determines the gap before each piece: one blank or none, except in columns.
//!
//! A column consists of pieces of one sort at one position, in statements of one kind without a blank line between them. At
//! least one of them follows a gap of two or more blanks. A continuation line below a piece of its statement's last line is a
//! column, too. A column remains, as far left as its widest line and its narrowest written gap permit. A piece after a wide gap
//! that just misses a column of its sort joins that column. Numbers aligned by their first or last digit keep their gap.

use std::collections::BTreeMap;

use super::pieces::{Piece, What};
use super::rows::Row;
use super::spacing;
use crate::syntax;

/// Returns the gaps before the pieces; the gap before the first piece of a row is its indentation.
pub(super) fn gaps(pieces: &[Piece<'_>], rows: &[Row], keeps_number_columns: bool) -> Vec<usize> {
    let mut gaps = vec![0; pieces.len()];
    let mut rows_of = vec![0; pieces.len()];
    let mut signs = vec![false; pieces.len()];
    for (number, row) in rows.iter().enumerate() {
        let mut statement = row.statement;
        for index in row.pieces.clone() {
            rows_of[index] = number;
            let is_first = index == row.pieces.start;
            // Comments may precede a statement on its line.
            if !row.goes_on && index > 0 && !is_first && pieces[statement].is_comment() {
                statement = index;
            }
            signs[index] = spacing::is_sign(pieces, index, statement);
            gaps[index] = match is_first {
                true => row.indent,
                false => spacing::gap(pieces, index, statement),
            };
        }
    }
    let mut columns = Columns {
        pieces,
        rows,
        signs,
        usual: gaps.clone(),
        column_of: vec![None; pieces.len()],
        columns: Vec::new(),
        hangs: vec![false; pieces.len()],
        kept: Vec::new(),
    };
    columns.find();
    if keeps_number_columns {
        for &index in &columns.kept {
            gaps[index] = pieces[index].gap;
        }
    }
    columns.settle(&rows_of, &mut gaps);
    gaps
}

/// Pieces aligned below one another.
struct Column<'a> {
    /// Written position.
    place: usize,
    sort: Option<Alike<'a>>,
    members: Vec<usize>,
    /// True if the column is kept.
    is_meant: bool,
}

/// Key of pieces that may be aligned: kind of statement, first line or continuation, and sort.
type Alike<'a> = (&'a str, bool, Sort);

/// Sort of pieces that may be aligned.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Sort {
    Operand,
    /// A word such as `at`, before an operand.
    Clause,
    Mark(u8),
    Brace,
    Pair,
    Comment,
}

/// A number with its sign: index of the first piece, first column, and column after the end.
type Digits = (usize, usize, usize);

struct Columns<'a> {
    pieces: &'a [Piece<'a>],
    rows: &'a [Row],
    /// True for each piece that is the sign of a number.
    signs: Vec<bool>,
    usual: Vec<usize>,
    columns: Vec<Column<'a>>,
    /// Column of each piece; `None` if it belongs to none.
    column_of: Vec<Option<usize>>,
    /// True for each piece that begins a line below a piece of the line above.
    hangs: Vec<bool>,
    /// Numbers that keep their gap.
    kept: Vec<usize>,
}

impl<'a> Columns<'a> {
    /// Finds aligned pieces.
    fn find(&mut self) {
        let mut paragraph = Vec::new();
        for row in self.rows {
            let pieces = &self.pieces[row.pieces.clone()];
            let is_tall = pieces.iter().any(Piece::is_tall);
            if row.blank_before || is_tall {
                self.find_in(&std::mem::take(&mut paragraph));
            }
            if !is_tall && !pieces.iter().all(Piece::is_comment) {
                paragraph.push(row);
            }
        }
        self.find_in(&paragraph);
        self.kept.sort_unstable();
        self.kept.dedup();
    }

    /// Finds aligned pieces in lines without a blank line between them.
    fn find_in(&mut self, rows: &[&Row]) {
        let first_column = self.columns.len();
        let mut column_at: BTreeMap<(Alike<'_>, usize), usize> = BTreeMap::new();
        let mut last: Option<&Row> = None;
        for row in rows {
            if let Some(above) = last {
                self.compare_numbers(above, row);
            }
            for index in row.pieces.clone().skip(1) {
                let Some(sort) = self.sort(index) else {
                    continue;
                };
                let sort = (self.kind(row), row.goes_on, sort);
                let place = self.pieces[index].column;
                let column = *column_at.entry((sort, place)).or_insert_with(|| {
                    self.columns.push(Column {
                        place,
                        sort: Some(sort),
                        members: Vec::new(),
                        is_meant: false,
                    });
                    self.columns.len() - 1
                });
                self.enter(index, column);
            }
            last = Some(row);
        }
        for column in &mut self.columns[first_column..] {
            let is_apart = |&it: &usize| self.pieces[it].gap > self.usual[it];
            column.is_meant = column.members.len() > 1 && column.members.iter().any(is_apart);
        }
        for pair in rows.windows(2) {
            self.hang(pair[0], pair[1]);
        }
        for row in rows {
            for index in row.pieces.clone().skip(1) {
                self.join(index, row, first_column);
            }
        }
    }

    fn enter(&mut self, index: usize, column: usize) {
        self.columns[column].members.push(index);
        self.column_of[index] = Some(column);
    }

    /// Notes a line that continues below a piece of the line above.
    fn hang(&mut self, above: &Row, below: &Row) {
        let first = below.pieces.start;
        let place = self.pieces[first].column;
        if !below.goes_on {
            return;
        }
        let mut upper = above.pieces.clone();
        let Some(other) = upper.find(|&it| self.pieces[it].column == place) else {
            return;
        };
        if other == above.pieces.start && !self.hangs[other] {
            return;
        }
        let meant = self.column_of[other].filter(|&it| self.columns[it].is_meant);
        let column = meant.unwrap_or_else(|| {
            self.columns.push(Column {
                place,
                sort: None,
                members: Vec::new(),
                is_meant: true,
            });
            let column = self.columns.len() - 1;
            self.enter(other, column);
            column
        });
        self.enter(first, column);
        self.hangs[first] = true;
    }

    /// Moves a piece after a wide gap, alone at its position, to the nearest column of its sort. It must not change places with
    /// another column of its line.
    fn join(&mut self, index: usize, row: &Row, first_column: usize) {
        let Some(own) = self.column_of[index] else {
            return;
        };
        let piece = &self.pieces[index];
        if self.columns[own].is_meant || piece.gap <= self.usual[index] {
            return;
        }
        let place_of = |other: usize| {
            let column = &self.columns[self.column_of[other]?];
            column.is_meant.then_some(column.place)
        };
        let left = (row.pieces.start..index).filter_map(place_of).max();
        let right = (index + 1..row.pieces.end).filter_map(place_of).min();
        let others = self.columns.iter().enumerate().skip(first_column);
        let candidates = others.filter(|(_, column)| {
            column.is_meant
                && column.sort == self.columns[own].sort
                && left.is_none_or(|it| it < column.place)
                && right.is_none_or(|it| it > column.place)
        });
        let nearest = candidates.min_by_key(|(_, column)| column.place.abs_diff(piece.column));
        if let Some((nearest, _)) = nearest {
            self.enter(index, nearest);
        }
    }

    /// Finds numbers aligned by their first or last digit.
    fn compare_numbers(&mut self, above: &Row, below: &Row) {
        let numbers = |row: &Row| -> Vec<Digits> {
            let inside = row.pieces.clone().skip(1);
            let numbers = inside.filter_map(|index| {
                let end = self.end_of_number(index)?;
                Some((index, self.pieces[index].column, end))
            });
            numbers.collect()
        };
        let (upper, lower) = (numbers(above), numbers(below));
        let mut aligned = Vec::new();
        for place in [|it: &Digits| it.1, |it: &Digits| it.2] {
            let mut others = upper.iter().peekable();
            for number in &lower {
                while others.next_if(|it| place(it) < place(number)).is_some() {}
                if let Some(other) = others.peek()
                    && place(other) == place(number)
                {
                    aligned.extend([number.0, other.0]);
                }
            }
        }
        let is_apart = |index: &usize| self.pieces[*index].gap > self.usual[*index];
        self.kept.extend(aligned.into_iter().filter(is_apart));
    }

    /// Returns the column after a number that starts, with its sign, at this piece; `None` without a number.
    fn end_of_number(&self, index: usize) -> Option<usize> {
        let number = index + usize::from(self.signs[index]);
        let is_signed = index > 0 && self.signs[index - 1];
        let piece = self.pieces.get(number)?;
        let is_number = piece.what == What::Number && !is_signed;
        is_number.then(|| piece.column + piece.width())
    }

    /// Returns the kind of a row's statement: its first word, with one kind for all declarations and one for all joints.
    fn kind(&self, row: &Row) -> &'a str {
        let mut words = self.pieces[row.statement..].iter();
        let word = words.find(|it| !it.is_comment()).map_or("", |it| it.text);
        match word {
            "param" | "input" => "const",
            "damper" => "spring",
            _ if syntax::KEYWORDS.contains(&word) => word,
            _ => "",
        }
    }

    /// Returns the sort of a piece after a blank; `None` if it is not aligned, or is a number, for which other rules hold.
    fn sort(&self, index: usize) -> Option<Sort> {
        if self.usual[index] == 0 || self.end_of_number(index).is_some() {
            return None;
        }
        Some(match self.pieces[index].what {
            What::Open(b'{') | What::Close(_) => Sort::Brace,
            What::Word if spacing::is_clause(self.pieces, index) => Sort::Clause,
            What::Word | What::Number | What::Text | What::Open(_) => Sort::Operand,
            What::Mark(_) if self.signs[index] => Sort::Operand,
            What::LineComment | What::BlockComment => Sort::Comment,
            What::Mark(mark) => Sort::Mark(mark),
            What::Pair => Sort::Pair,
        })
    }

    /// Sets the gaps of the pieces of each column, from left to right.
    fn settle(&self, rows_of: &[usize], gaps: &mut [usize]) {
        let mut columns: Vec<&Column<'_>> = self.columns.iter().filter(|it| it.is_meant).collect();
        columns.sort_by_key(|column| column.place);
        // Progress of each row: the next piece, and the column after the previous one.
        let mut reached: Vec<(usize, usize)> =
            self.rows.iter().map(|row| (row.pieces.start, 0)).collect();
        for column in columns {
            let mut end_before = |index: usize, gaps: &[usize]| {
                let (next, column) = &mut reached[rows_of[index]];
                while *next < index {
                    *column += gaps[*next] + self.pieces[*next].width();
                    *next += 1;
                }
                *column
            };
            let inside = column.members.iter().filter(|&&it| !self.hangs[it]);
            let is_there = |it: usize| self.pieces[it].column == column.place;
            let gap = |it: usize| self.pieces[it].gap.max(self.usual[it]);
            let narrowest = inside.clone().filter(|&&it| is_there(it));
            let narrowest = narrowest.map(|&it| gap(it)).min().unwrap_or(0);
            let reaches = inside.map(|&it| {
                // The written gap does not apply to a piece that has joined the column.
                let gap = if is_there(it) {
                    narrowest
                } else {
                    self.usual[it]
                };
                end_before(it, gaps) + gap
            });
            let place = reaches.max().unwrap_or(0);
            for &index in &column.members {
                gaps[index] = place - end_before(index, gaps);
            }
        }
    }
}
