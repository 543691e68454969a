//! *Lines → the gap before each piece.* One blank or none, except where columns are written.
//!
//! Pieces of one sort that stand at the same place in statements of one kind without a blank line between them, at least one of them behind a gap of
//! two or more blanks, are a column, and so is what goes on below something in its statement's last line. A column stays one, as far
//! left as its widest line and its narrowest written gap let it; a piece behind such a gap that just misses a column of its sort
//! joins it. Numbers that are written below one another, by their first or by their last digit, keep the gap that they have.

use std::collections::BTreeMap;

use super::pieces::{Piece, What};
use super::rows::Row;
use super::spacing;
use crate::syntax;

/// The gaps before the pieces; that before the first piece of a row is its indentation.
pub(super) fn gaps(pieces: &[Piece<'_>], rows: &[Row], keeps_number_columns: bool) -> Vec<usize> {
    let mut gaps = vec![0; pieces.len()];
    let mut rows_of = vec![0; pieces.len()];
    let mut signs = vec![false; pieces.len()];
    for (number, row) in rows.iter().enumerate() {
        let mut statement = row.statement;
        for index in row.pieces.clone() {
            rows_of[index] = number;
            let is_first = index == row.pieces.start;
            // Comments may stand before a statement on its line.
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

/// What stands below one another.
struct Column<'a> {
    /// Where it is written.
    place: usize,
    sort: Option<Alike<'a>>,
    members: Vec<usize>,
    /// Whether it stays a column.
    is_meant: bool,
}

/// What may stand below one another: pieces of one sort in lines of one kind of statement, in its first line or below.
type Alike<'a> = (&'a str, bool, Sort);

/// Pieces of one sort may stand below one another.
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

/// A number with its sign: its first piece, where it begins, and where it ends.
type Digits = (usize, usize, usize);

struct Columns<'a> {
    pieces: &'a [Piece<'a>],
    rows: &'a [Row],
    /// Which pieces are signs of numbers.
    signs: Vec<bool>,
    usual: Vec<usize>,
    columns: Vec<Column<'a>>,
    /// The column that each piece belongs to.
    column_of: Vec<Option<usize>>,
    /// Which pieces begin a line below something in the line above.
    hangs: Vec<bool>,
    /// Numbers that keep their gap.
    kept: Vec<usize>,
}

impl<'a> Columns<'a> {
    /// Looks which pieces stand below one another.
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

    /// The same in lines without a blank line between them.
    fn find_in(&mut self, rows: &[&Row]) {
        let first_column = self.columns.len();
        let mut found: BTreeMap<(Alike<'_>, usize), usize> = BTreeMap::new();
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
                let column = *found.entry((sort, place)).or_insert_with(|| {
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

    /// Notes whether a line goes on below something in the line above.
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

    /// Brings a piece behind a wide gap, alone at its place, to the nearest column of its sort that it can join without changing
    /// places with another column of its line.
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
        let wanted = others.filter(|(_, column)| {
            column.is_meant
                && column.sort == self.columns[own].sort
                && left.is_none_or(|it| it < column.place)
                && right.is_none_or(|it| it > column.place)
        });
        let nearest = wanted.min_by_key(|(_, column)| column.place.abs_diff(piece.column));
        if let Some((nearest, _)) = nearest {
            self.enter(index, nearest);
        }
    }

    /// Numbers below one another, by their first or by their last digit.
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
        let mut found = Vec::new();
        for place in [|it: &Digits| it.1, |it: &Digits| it.2] {
            let mut others = upper.iter().peekable();
            for number in &lower {
                while others.next_if(|it| place(it) < place(number)).is_some() {}
                if let Some(other) = others.peek()
                    && place(other) == place(number)
                {
                    found.extend([number.0, other.0]);
                }
            }
        }
        let is_apart = |index: &usize| self.pieces[*index].gap > self.usual[*index];
        self.kept.extend(found.into_iter().filter(is_apart));
    }

    /// The column behind a number that starts, with its sign, at this piece.
    fn end_of_number(&self, index: usize) -> Option<usize> {
        let number = index + usize::from(self.signs[index]);
        let is_signed = index > 0 && self.signs[index - 1];
        let piece = self.pieces.get(number)?;
        let is_number = piece.what == What::Number && !is_signed;
        is_number.then(|| piece.column + piece.width())
    }

    /// The kind of the statement that a row belongs to: its first word, one for all declarations and one for all joints.
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

    /// What a piece can stand below, where a blank stands before it. Numbers have rules of their own.
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

    /// Gives the pieces of each column their gaps, columns from left to right.
    fn settle(&self, rows_of: &[usize], gaps: &mut [usize]) {
        let mut columns: Vec<&Column<'_>> = self.columns.iter().filter(|it| it.is_meant).collect();
        columns.sort_by_key(|column| column.place);
        // How far each row is laid out: the next piece, and the column behind what stands before it.
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
                // What has joined is not where its gap says.
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
