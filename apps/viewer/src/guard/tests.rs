//! Is work lost only on demand? A guard and its answers, on scenes in files.

use std::path::Path;

use catoptra_core::scene::Edit;

use super::*;
use crate::keeping::Keeper;

const TEXT: &str = "matte \"grey\" { color 0.5 0.5 0.5 }\nsphere \"ball\" material=\"grey\" { radius 1 }\n";

/// A scene in a file of that folder, with an edit.
fn edited(folder: &Path) -> (PathBuf, Document) {
    let path = folder.join("ball.kdl");
    std::fs::write(&path, TEXT).unwrap();
    let mut document = Document::open(&path).unwrap();
    let ball = document.scene().entity_named("ball").unwrap();
    document.edit(Edit::Name(ball, "globe".to_owned())).unwrap();
    (path, document)
}

fn text(path: &Path) -> String {
    std::fs::read_to_string(path).unwrap()
}

/// What comes now.
fn next(guard: &mut Guard) -> Option<Next> {
    match guard.take_due()? {
        Due::Go(next) => Some(next),
        Due::Choose(next) => panic!("a file is to be chosen, and then comes {next:?}"),
    }
}

/// What is asked and what is due.
fn state(guard: &mut Guard) -> (Option<Question>, Option<Next>) {
    (guard.question().cloned(), next(guard))
}

#[test]
fn without_edits_nothing_is_asked() {
    let mut guard = Guard::default();
    guard.leave(Next::Close, &Document::welcome().unwrap());
    assert_eq!(state(&mut guard), (None, Some(Next::Close)));
    assert_eq!(next(&mut guard), None, "what is due is done once");
}

#[test]
fn edits_are_saved_first_or_given_up_or_kept() {
    let next = Next::Open("other.kdl".into());
    for (answer, due, written) in [
        (Answer::Write, Some(next.clone()), true),
        (Answer::GiveUp, Some(next.clone()), false),
        (Answer::Cancel, None, false),
    ] {
        let folder = tempfile::tempdir().unwrap();
        let (path, mut document) = edited(folder.path());
        let mut guard = Guard::default();
        guard.leave(next.clone(), &document);
        assert_eq!(state(&mut guard), (Some(Question::Unsaved(next.clone())), None));
        guard.answer(answer, &mut document);
        assert_eq!(state(&mut guard), (None, due), "{answer:?}");
        assert_eq!((document.is_saved(), text(&path).contains("globe")), (written, written), "{answer:?}");
    }
}

#[test]
fn the_newest_wish_counts() {
    let folder = tempfile::tempdir().unwrap();
    let (_, mut document) = edited(folder.path());
    let mut guard = Guard::default();
    guard.leave(Next::Open("other.kdl".into()), &document);
    guard.leave(Next::Close, &document);
    guard.answer(Answer::Write, &mut document);
    assert_eq!(next(&mut guard), Some(Next::Close));
}

#[test]
fn edits_made_while_a_file_is_read_are_asked_about() {
    let folder = tempfile::tempdir().unwrap();
    let (_, mut document) = edited(folder.path());
    let (mut guard, other) = (Guard::default(), Next::Open("other.kdl".into()));
    let wished_at = document.scene().revision();
    assert!(guard.lets_in(&other, wished_at, &document), "those edits were given up");
    let globe = document.scene().entity_named("globe").unwrap();
    document.edit(Edit::Remove(globe)).unwrap();
    assert!(!guard.lets_in(&other, wished_at, &document));
    assert_eq!(guard.question(), Some(&Question::Unsaved(other.clone())));
    guard.leave(Next::Close, &document);
    assert!(!guard.lets_in(&other, wished_at, &document));
    assert_eq!(guard.question(), Some(&Question::Unsaved(Next::Close)), "asked later");
    document.save().unwrap();
    assert!(guard.lets_in(&other, wished_at, &document));
}

#[test]
fn a_failed_save_keeps_the_question_and_tells_why() {
    let folder = tempfile::tempdir().unwrap();
    let inner = folder.path().join("inner");
    std::fs::create_dir(&inner).unwrap();
    let (_, mut document) = edited(&inner);
    std::fs::remove_dir_all(&inner).unwrap();
    let mut guard = Guard::default();
    guard.leave(Next::Close, &document);
    guard.answer(Answer::Write, &mut document);
    assert_eq!(state(&mut guard), (Some(Question::Unsaved(Next::Close)), None));
    assert!(guard.problem().unwrap().contains("was not saved"), "{:?}", guard.problem());
    assert!(!document.is_saved());
    guard.answer(Answer::GiveUp, &mut document);
    assert_eq!((guard.problem().is_none(), next(&mut guard)), (true, Some(Next::Close)));
}

#[test]
fn a_file_that_someone_else_has_changed_is_not_written_unasked() {
    for (answer, theirs, due) in
        [(Answer::Write, false, false), (Answer::GiveUp, true, true), (Answer::Cancel, true, false)]
    {
        let folder = tempfile::tempdir().unwrap();
        let (path, mut document) = edited(folder.path());
        std::fs::write(&path, TEXT.replace("radius 1", "radius 2")).unwrap();
        let mut guard = Guard::default();
        assert_eq!(guard.save(&mut document), None);
        assert_eq!(guard.question(), Some(&Question::Changed(None)));
        assert!(text(&path).contains("radius 2"));
        assert!(
            guard.difference().iter().any(|line| line.text.contains("radius 2")),
            "it is told what differs"
        );
        guard.answer(answer, &mut document);
        assert_eq!(guard.question(), None);
        assert_eq!(text(&path).contains("radius 2"), theirs, "{answer:?}");
        assert_eq!(next(&mut guard), due.then_some(Next::Open(path)), "{answer:?}");
        assert_eq!(document.is_saved(), answer == Answer::Write);
    }
}

#[test]
fn saving_before_closing_asks_about_a_changed_file_too() {
    let folder = tempfile::tempdir().unwrap();
    let (path, mut document) = edited(folder.path());
    std::fs::write(&path, "").unwrap();
    let mut guard = Guard::default();
    guard.leave(Next::Close, &document);
    guard.answer(Answer::Write, &mut document);
    assert_eq!(state(&mut guard), (Some(Question::Changed(Some(Next::Close))), None));
    guard.answer(Answer::Write, &mut document);
    assert_eq!(next(&mut guard), Some(Next::Close));
    assert!(text(&path).contains("globe"));
}

#[test]
fn showing_the_changed_file_closes_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let (path, mut document) = edited(folder.path());
    std::fs::write(&path, "").unwrap();
    let mut guard = Guard::default();
    guard.leave(Next::Close, &document);
    guard.answer(Answer::Write, &mut document);
    guard.answer(Answer::GiveUp, &mut document);
    assert_eq!(next(&mut guard), Some(Next::Open(path)));
}

#[test]
fn a_file_that_is_gone_is_written_again_unasked() {
    let folder = tempfile::tempdir().unwrap();
    let (path, mut document) = edited(folder.path());
    std::fs::remove_file(&path).unwrap();
    let told = Guard::default().save(&mut document).unwrap().unwrap();
    assert!(told.starts_with("saved ") && text(&path).contains("globe"), "{told}");
}

#[test]
fn the_second_of_two_viewers_is_asked_and_then_the_first() {
    let folder = tempfile::tempdir().unwrap();
    let (path, mut first) = edited(folder.path());
    let (_, mut second) = edited(folder.path());
    assert!(Guard::default().save(&mut first).is_some());
    let mut guard = Guard::default();
    assert_eq!(guard.save(&mut second), None);
    // The first has written what the second would write, and still the second is asked: it did not know of it.
    assert_eq!(guard.question(), Some(&Question::Changed(None)));
    second.undo();
    guard.answer(Answer::Write, &mut second);
    assert_eq!(text(&path), TEXT);
    assert_eq!(guard.save(&mut first), None);
    assert_eq!(guard.question(), Some(&Question::Changed(None)));
}

#[test]
fn a_changed_file_can_be_left_for_another() {
    let folder = tempfile::tempdir().unwrap();
    let (path, mut document) = edited(folder.path());
    std::fs::write(&path, "").unwrap();
    let mut guard = Guard::default();
    guard.leave(Next::Close, &document);
    guard.answer(Answer::Write, &mut document);
    guard.answer(Answer::Elsewhere, &mut document);
    assert_eq!(guard.take_due(), Some(Due::Choose(Some(Next::Close))));
    let other = folder.path().join("other.kdl");
    guard.save_to(other.clone(), &mut document, Some(Next::Close)).unwrap().unwrap();
    assert_eq!(next(&mut guard), Some(Next::Close));
    assert!(document.is_saved() && text(&other).contains("globe") && text(&path).is_empty());
}

#[test]
fn a_scene_without_a_file_is_asked_where_it_is_to_be_saved() {
    let mut document = Document::welcome().unwrap();
    let mut guard = Guard::default();
    assert_eq!(guard.save(&mut document), None);
    assert_eq!(guard.take_due(), Some(Due::Choose(None)));
}

#[test]
fn kept_edits_are_brought_back_unsaved_or_forgotten() {
    for (answer, stays, comes) in
        [(Answer::Write, true, true), (Answer::GiveUp, false, false), (Answer::Cancel, true, false)]
    {
        let folder = tempfile::tempdir().unwrap();
        let (path, document) = edited(folder.path());
        let unsaved = document.unsaved();
        let origin = unsaved.origin.clone();
        let keeper = Keeper::start(Some(folder.path().join("state")), |why| panic!("{why}"));
        let place = keeper.end(Some(unsaved)).unwrap().unwrap();
        let kept = Kept { place, origin };
        let mut guard = Guard::default();
        guard.offer(kept.clone());
        guard.answer(answer, &mut Document::open(&path).unwrap());
        assert_eq!(next(&mut guard), comes.then(|| Next::Recover(kept.clone())), "{answer:?}");
        assert_eq!(kept.place.exists(), stays, "{answer:?}");
        if comes {
            let mut recovered = Document::recover(&kept).unwrap();
            assert!(!recovered.is_saved() && recovered.scene().entity_named("globe").is_some());
            assert_eq!(recovered.on_disk(), OnDisk::Same);
            recovered.save().unwrap();
            assert!(recovered.is_saved() && text(&path).contains("globe"));
        }
    }
}
